// Colour tables of mist (MIST-TABLE 1) for renderers: load, look up, look through a filter.
//
//     mist::Table table = mist::Table::load("gold.mtab");
//     mist::Value value = table.lookup(thetai, thetas, phis);   // degrees
//     std::array<double, 3> rgb = value.filtered(30);           // behind a polarizer, 30° from s
//
// C++17, no dependencies. A file that is cut off, a direction outside of the grid and a filter for a table
// without Stokes components are refused: std::runtime_error. The format is
// described in docs/formats/mtab.md; values are linear, for the colour space named in the header.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <istream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace mist {

// What a direction has: R, G, B and their Stokes components, if the table has them.
struct Value {
    std::array<double, 3> rgb{}, q{}, u{}, v{};
    double intensity = 0;
    // True if the table has Q and U of each channel.
    bool polarized = false;

    // Linear RGB behind a linear polarizer at `degrees` from s.
    std::array<double, 3> filtered(double degrees) const {
        if (!polarized) throw std::runtime_error("the table has no Stokes components: ask for it with stokes=1");
        const double angle = degrees * std::acos(-1.0) / 90, c = std::cos(angle), s = std::sin(angle);
        std::array<double, 3> out{};
        for (int i = 0; i < 3; i++) out[i] = 0.5 * (rgb[i] + c * q[i] + s * u[i]);
        return out;
    }
};

class Table {
public:
    static Table load(const std::string& path) {
        std::ifstream file(path);
        if (!file) throw std::runtime_error("cannot open " + path);
        return read(file);
    }

    static Table read(std::istream& in) {
        Table table;
        std::string line;
        if (!std::getline(in, line) || line != "# MIST-TABLE 1")
            throw std::runtime_error("the first line is not '# MIST-TABLE 1'");
        long rows = 0, stated = -1;
        while (std::getline(in, line)) {
            if (!line.empty() && line[0] == '#') {
                std::istringstream words(line.substr(1));
                std::string key;
                words >> key;
                if (key == "end") words >> stated;
                else table.header_line(key, words);
                continue;
            }
            table.row(line);
            rows++;
        }
        if (rows != stated) throw std::runtime_error("the table is cut off");
        table.check(rows);
        return table;
    }

    // The value in a direction (degrees), linear between nodes; azimuths are taken modulo 360.
    Value lookup(double thetai, double thetas, double phis) const {
        if (axes_.size() != 3) throw std::runtime_error("this table is a list, not a grid");
        phis = std::remainder(phis, 360.0);
        const bool mirrored = mirror_ && phis < 0;
        if (mirrored) phis = -phis;
        if (phis < axes_[2].front() - EDGE) phis += 360;
        if (phis > axes_[2].back() + EDGE) phis -= 360;
        const double angles[3] = {thetai, thetas, phis};
        for (int a = 0; a < 3; a++)
            if (!(angles[a] >= axes_[a].front() - EDGE && angles[a] <= axes_[a].back() + EDGE))
                throw std::runtime_error("the direction is outside of the grid of the table");
        std::size_t low[3], next[3];
        double part[3];
        for (int a = 0; a < 3; a++) cell(axes_[a], angles[a], low[a], next[a], part[a]);
        std::vector<double> sum(columns_.size(), 0.0);
        for (int corner = 0; corner < 8; corner++) {
            double weight = 1;
            std::size_t index = 0;
            for (int a = 0; a < 3; a++) {
                const bool high = corner >> a & 1;
                weight *= high ? part[a] : 1 - part[a];
                index = index * axes_[a].size() + (high ? next[a] : low[a]);
            }
            if (weight == 0) continue;
            const double* row = &numbers_[index * columns_.size()];
            for (std::size_t c = 0; c < sum.size(); c++) sum[c] += weight * row[c];
        }
        return value(sum.data(), mirrored);
    }

    // The value of a row, as it stands in the file.
    Value at(std::size_t row) const { return value(&numbers_.at(row * columns_.size()), false); }

    std::size_t rows() const { return columns_.empty() ? 0 : numbers_.size() / columns_.size(); }
    const std::vector<std::string>& columns() const { return columns_; }
    const std::map<std::string, std::string>& header() const { return header_; }
    const std::vector<std::vector<double>>& axes() const { return axes_; }

private:
    std::map<std::string, std::string> header_;
    std::vector<std::string> columns_;
    std::vector<std::vector<double>> axes_;
    std::vector<double> numbers_;
    bool mirror_ = false;
    // Degrees by which a direction may miss the end of an axis, for rounding.
    static constexpr double EDGE = 1e-9;

    void header_line(const std::string& key, std::istringstream& words) {
        std::string word;
        if (key == "columns") {
            while (words >> word) columns_.push_back(word);
        } else if (key == "axis") {
            std::size_t count = 0;
            words >> word >> count;
            std::vector<double> nodes;
            for (double node; words >> node;) nodes.push_back(node);
            if (nodes.empty() || nodes.size() != count) throw std::runtime_error("axis " + word + " is cut off");
            axes_.push_back(nodes);
        } else {
            std::getline(words >> std::ws, header_[key]);
            mirror_ = mirror_ || (key == "symmetry" && header_[key] == "mirror");
        }
    }

    void row(const std::string& line) {
        const char* at = line.c_str();
        for (std::size_t c = 0; c < columns_.size(); c++) {
            char* end = nullptr;
            numbers_.push_back(std::strtod(at, &end));
            if (end == at) throw std::runtime_error("a row has too few numbers: " + line);
            at = end;
        }
    }

    void check(long rows) const {
        std::size_t nodes = 1;
        for (const auto& axis : axes_) nodes *= axis.size();
        if (!axes_.empty() && nodes != static_cast<std::size_t>(rows))
            throw std::runtime_error("the table has not a row for every node");
    }

    static void cell(const std::vector<double>& nodes, double angle, std::size_t& low, std::size_t& next, double& part) {
        const auto above = std::upper_bound(nodes.begin(), nodes.end(), angle) - nodes.begin();
        const long last = static_cast<long>(nodes.size()) - 1;
        low = static_cast<std::size_t>(std::clamp<long>(above - 1, 0, std::max(last - 1, 0L)));
        next = std::min<std::size_t>(low + 1, static_cast<std::size_t>(last));
        part = next == low ? 0 : std::clamp((angle - nodes[low]) / (nodes[next] - nodes[low]), 0.0, 1.0);
    }

    Value value(const double* row, bool mirrored) const {
        Value out;
        const std::string channels = "RGB";
        int polarized = 0;
        for (std::size_t c = 0; c < columns_.size(); c++) {
            const std::string& name = columns_[c];
            if (name == "I") out.intensity = row[c];
            const auto channel = channels.find(name[0]);
            if (channel == std::string::npos || name.size() > 2) continue;
            // U and V change their signs in the mirror at the plane of incidence.
            const char stokes = name.size() == 2 ? name[1] : 'I';
            if (stokes == 'I') out.rgb[channel] = row[c];
            polarized += stokes == 'Q' || stokes == 'U';
            if (stokes == 'Q') out.q[channel] = row[c];
            if (stokes == 'U') out.u[channel] = mirrored ? -row[c] : row[c];
            if (stokes == 'V') out.v[channel] = mirrored ? -row[c] : row[c];
        }
        out.polarized = polarized == 6;
        return out;
    }
};

}  // namespace mist
