// Line graphs and polar graphs as SVG.

import { draw, make } from "./dom.js";

/** Colours of curves, the same in the legend. */
export const colour = (at) => `var(--c${at % 6})`;

/** A graph of curves [{name, points: [[x, y]…]}] with named axes; `log` for the y axis. */
export function lines(curves, { x = "", y = "", log = false } = {}) {
  const [width, height, left, bottom] = [640, 360, 72, 46];
  const scale = log ? Math.log10 : (value) => value;
  const fits = ([px, py]) => Number.isFinite(px) && Number.isFinite(scale(py));
  const points = curves.flatMap((curve) => curve.points.filter(fits));
  if (!points.length) return make("p", { class: "quiet" }, "No data to plot.");
  const across = axis(points.map((point) => point[0]), left, width - 14);
  const up = axis(points.map((point) => scale(point[1])), height - bottom, 12, !log);
  const svg = draw("svg", { viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `${y} over ${x}` });
  for (const at of across.ticks) {
    svg.append(draw("line", { class: "grid", x1: across(at), x2: across(at), y1: 12, y2: height - bottom }),
      draw("text", { x: across(at), y: height - bottom + 18, "text-anchor": "middle" }, short(at)));
  }
  for (const at of up.ticks) {
    svg.append(draw("line", { class: "grid", x1: left, x2: width - 14, y1: up(at), y2: up(at) }),
      draw("text", { x: left - 8, y: up(at) + 4, "text-anchor": "end" }, short(log ? 10 ** at : at)));
  }
  svg.append(draw("text", { x: (left + width) / 2, y: height - 8, "text-anchor": "middle" }, x),
    draw("text", { x: 14, y: height / 2, transform: `rotate(-90 14 ${height / 2})`, "text-anchor": "middle" }, y));
  curves.forEach((curve, at) => {
    const place = ([px, py]) => `${across(px).toFixed(2)},${up(scale(py)).toFixed(2)}`;
    const kept = curve.points.filter(fits);
    svg.append(draw("polyline", { class: "curve", stroke: curve.colour ?? colour(at), points: kept.map(place).join(" ") }));
    if (kept.length === 1) {
      for (const [px, py] of kept) {
        svg.append(draw("circle", { cx: across(px), cy: up(scale(py)), r: 3, fill: colour(at) }));
      }
    }
  });
  return svg;
}

/** A polar graph over −90° … 90° from the normal: curves [{name, points: [[degrees, value]…]}]. */
export function polar(curves, { log = false, title = "" } = {}) {
  const [radius, decades] = [240, 5];
  const values = curves.flatMap((curve) => curve.points.map((point) => Math.abs(point[1])));
  const most = Math.max(...values.filter(Number.isFinite), 1e-300);
  const reach = (value) => {
    const part = Math.abs(value) / most;
    return radius * (log ? Math.max(0, 1 + Math.log10(part) / decades) : part);
  };
  const svg = draw("svg", { viewBox: "-270 -270 540 310", role: "img", "aria-label": title });
  for (const part of [0.25, 0.5, 0.75, 1]) {
    const r = radius * part;
    svg.append(draw("path", { class: "grid", fill: "none", d: `M ${-r} 0 A ${r} ${r} 0 0 1 ${r} 0` }));
    const value = log ? most * 10 ** (decades * (part - 1)) : most * part;
    svg.append(draw("text", { x: 4, y: -r - 3 }, short(value)));
  }
  for (let angle = -90; angle <= 90; angle += 30) {
    const [sin, cos] = turn(angle);
    svg.append(draw("line", { class: "grid", x1: 0, y1: 0, x2: radius * sin, y2: -radius * cos }),
      draw("text", { x: 256 * sin, y: 4 - 256 * cos, "text-anchor": "middle" }, `${angle}°`));
  }
  curves.forEach((curve, at) => {
    const place = ([angle, value]) => {
      const [sin, cos] = turn(angle);
      const r = reach(value);
      return `${(r * sin).toFixed(2)},${(-r * cos).toFixed(2)}`;
    };
    // Negative parts are dashed: a radius has no sign.
    for (const sign of [1, -1]) {
      for (const run of runs(curve.points, ([, value]) => sign * value > 0)) {
        const dash = sign < 0 ? "5 4" : "none";
        svg.append(draw("polyline", { class: "curve", stroke: colour(at), "stroke-dasharray": dash, points: run.map(place).join(" ") }));
      }
    }
  });
  return svg;
}

/** The names of curves with their colours. */
export const legend = (curves) =>
  make("div", { class: "legend" }, ...curves.map((curve, at) =>
    make("span", {}, make("i", { style: `background:${curve.colour ?? colour(at)}` }), curve.name)));

/** A short text of a number. */
export function short(value) {
  if (value === 0) return "0";
  const size = Math.abs(value);
  return size >= 1e4 || size < 1e-3 ? value.toExponential(1) : String(Number(value.toPrecision(4)));
}

function turn(degrees) {
  const angle = (degrees * Math.PI) / 180;
  return [Math.sin(angle), Math.cos(angle)];
}

/** The longest runs of `points` for which `wanted` is true. */
function runs(points, wanted) {
  const found = [[]];
  for (const point of points) {
    if (wanted(point)) found.at(-1).push(point);
    else if (found.at(-1).length) found.push([]);
  }
  return found.filter((run) => run.length > 1);
}

/** A map from values to places, with round ticks; `zero` includes 0. */
function axis(values, from, to, zero = false) {
  let low = Infinity;
  let high = -Infinity;
  for (const value of values) {
    low = Math.min(low, value);
    high = Math.max(high, value);
  }
  if (zero) [low, high] = [Math.min(low, 0), Math.max(high, 0)];
  if (high - low < 1e-12 * Math.max(1, Math.abs(high))) [low, high] = [low - 0.5, high + 0.5];
  const rough = (high - low) / 6;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= rough);
  const place = (value) => from + ((value - low) / (high - low)) * (to - from);
  place.ticks = [];
  for (let at = Math.ceil(low / step); at * step <= high * (1 + 1e-12) + 1e-12 * step; at += 1) {
    place.ticks.push(Number((at * step).toPrecision(12)));
  }
  return place;
}
