// Polar plots of the lobe in and out of the plane of incidence, one curve per Stokes parameter.

import { evaluate } from "./api.js";
import { legend, polar } from "./chart.js";
import { choice, make, number, tick } from "./dom.js";
import { INCIDENT, set, state } from "./state.js";

const NAMES = ["I", "Q", "U", "V"];
const STEP = 1;

/** The view. */
export async function show(place, material, signal) {
  const controls = make("div", { class: "controls" },
    number("θi °", state.thetai, (thetai) => set({ thetai }), { min: 0, max: 89, step: 1 }),
    choice("light", Object.keys(INCIDENT), state.incident, (incident) => set({ incident })),
    tick("logarithmic", state.log, (log) => set({ log })));
  place.replaceChildren(controls);
  if (!material.model) {
    place.append(make("p", { class: "quiet" }, "Polar plots show a model: choose one in the tab Model."));
    return;
  }
  const planes = [["In the plane of incidence", 0], ["Across the plane of incidence", 90]];
  const angles = [];
  for (let angle = -89; angle <= 89; angle += STEP) angles.push(angle);
  const radians = Math.PI / 180;
  const geometries = planes.flatMap(([, phi]) => angles.map((angle) => ({
    theta_i: state.thetai * radians,
    theta_s: Math.abs(angle) * radians,
    phi_s: (angle < 0 ? phi + 180 : phi) * radians,
  })));
  const matrices = await evaluate({ ...material, geometries }, signal);
  const light = INCIDENT[state.incident];
  const stokes = matrices.map((m) =>
    NAMES.map((_, row) => light.reduce((sum, part, column) => sum + Number(m[4 * row + column]) * part, 0)));
  const pair = make("div", { class: "pair" });
  planes.forEach(([title], plane) => {
    const curves = NAMES.map((name, row) => ({
      name,
      points: angles.map((angle, at) => [angle, stokes[plane * angles.length + at][row]]),
    }));
    pair.append(make("figure", {}, polar(curves, { log: state.log, title }), make("figcaption", {}, title)));
  });
  place.append(pair, legend(NAMES.map((name) => ({ name }))),
    make("p", { class: "quiet" }, "Mueller BRDF times the Stokes vector of the light, 1/sr; dashed where negative. "
      + "Q > 0 is s-polarized, V > 0 left circular."));
}
