// Graphs of a run's columns over its loop variables, and its table.

import { colour, legend, lines } from "./chart.js";
import { choice, make, tick } from "./dom.js";
import { set, state } from "./state.js";

const ROWS = 500;

/** Contents of a results file: names of the columns and rows of numbers. */
export function parse(text) {
  const all = text.split("\n").map((line) => line.trim().split(/\s+/)).filter((words) => words[0] !== "");
  const isRow = (words) => words.every((word) => /^[-+]?(\d|\.\d|nan|inf)/i.test(word));
  const first = all.findIndex(isRow);
  if (first < 0) return { names: all.at(-1) ?? [], rows: [] };
  const rows = all.slice(first).filter(isRow).map((words) => words.map(Number));
  const names = all[first - 1] ?? rows[0].map((_, at) => `column ${at + 1}`);
  return { names, rows };
}

const picked = { x: null, curves: null };

/** The view of the last results. */
export async function show(place, results) {
  if (!results) {
    place.replaceChildren(make("p", { class: "quiet" }, "Run a program in the tab Program to see its results here."));
    return;
  }
  const { names, rows } = parse(results);
  if (!names.includes(picked.x)) picked.x = names[0];
  if (!picked.curves?.every((name) => names.includes(name))) picked.curves = names.slice(-1);
  const again = () => show(place, results);
  const boxes = names.filter((name) => name !== picked.x).map((name) =>
    tick(name, picked.curves.includes(name), (on) => {
      picked.curves = names.filter((one) => (one === name ? on : picked.curves.includes(one)));
      again();
    }));
  place.replaceChildren(
    make("div", { class: "controls" },
      choice("over", names, picked.x, (x) => { picked.x = x; again(); }),
      tick("logarithmic", state.log, (log) => set({ log })), ...boxes));
  const curves = picked.curves.flatMap((name) => split(names, rows, picked.x, name));
  curves.forEach((curve, at) => { curve.colour = colour(at); });
  place.append(lines(curves, { x: picked.x, y: picked.curves.join(", "), log: state.log }),
    curves.length <= 12 ? legend(curves) : make("p", { class: "quiet" }, `${curves.length} curves`),
    sheet(names, rows));
}

/** One curve for every run of rows with monotonic x; inner loops give several. */
function split(names, rows, x, name) {
  const [over, value] = [names.indexOf(x), names.indexOf(name)];
  const curves = [];
  let last = null;
  let way = 0;
  for (const row of rows) {
    const step = last === null ? 0 : Math.sign(row[over] - last);
    if (last === null || step === 0 || (way !== 0 && step !== way)) {
      curves.push({ name: `${name}${curves.length ? ` (${curves.length + 1})` : ""}`, points: [] });
      way = 0;
    } else {
      way = step;
    }
    curves.at(-1).points.push([row[over], row[value]]);
    last = row[over];
  }
  return curves;
}

function sheet(names, rows) {
  const head = make("tr", {}, ...names.map((name) => make("th", { scope: "col" }, name)));
  const body = rows.slice(0, ROWS).map((row) => make("tr", {}, ...row.map((value) => make("td", {}, String(value)))));
  const more = rows.length > ROWS ? `, the first ${ROWS} shown` : "";
  return make("details", {}, make("summary", {}, `Table: ${rows.length} rows${more}`),
    make("div", { class: "scroll" }, make("table", { id: "results" }, make("thead", {}, head), make("tbody", {}, ...body))));
}
