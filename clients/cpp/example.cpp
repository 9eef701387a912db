// Prints linear RGB of a table in a direction, without and with a polarizing filter.
//
//     c++ -std=c++17 example.cpp -o example && ./example gold.mtab 45 44 10 30
#include "mist_table.hpp"

#include <cstdio>
#include <cstdlib>
#include <exception>

int main(int count, char** given) {
    if (count != 6) {
        std::fprintf(stderr, "usage: %s TABLE.mtab THETAI THETAS PHIS FILTER (degrees)\n", given[0]);
        return 2;
    }
    try {
        const mist::Value value = mist::Table::load(given[1]).lookup(
            std::atof(given[2]), std::atof(given[3]), std::atof(given[4]));
        const auto filtered = value.filtered(std::atof(given[5]));
        std::printf("%.9g %.9g %.9g\n", value.rgb[0], value.rgb[1], value.rgb[2]);
        std::printf("%.9g %.9g %.9g\n", filtered[0], filtered[1], filtered[2]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
