// Points on the scattering hemisphere: those that a run evaluated, or a grid over a model.

import { evaluate } from "./api.js";
import { INCIDENT, state } from "./state.js";

const RINGS = 24;

/** The points of a samples file: lines `order thetas phis x y z BRDF`. */
export function parse(text) {
  const rows = text.split("\n").map((line) => line.trim().split(/\s+/).map(Number));
  return rows
    .filter((row) => row.length >= 7 && row.every(Number.isFinite))
    .map((row) => ({ at: row.slice(3, 6), value: row[6] }));
}

/** Points of nearly equal solid angles with the BRDF of `material` for the light of the page. */
export async function ofModel(material, signal) {
  const theta_i = (state.thetai * Math.PI) / 180;
  const geometries = [];
  for (let ring = 0; ring < RINGS; ring += 1) {
    const theta_s = ((ring + 0.5) / RINGS) * (Math.PI / 2);
    const count = Math.max(1, Math.round(4 * RINGS * Math.sin(theta_s)));
    for (let step = 0; step < count; step += 1) {
      geometries.push({ theta_i, theta_s, phi_s: (2 * Math.PI * step) / count });
    }
  }
  const matrices = await evaluate({ ...material, geometries }, signal);
  const light = INCIDENT[state.incident];
  return geometries.map(({ theta_s, phi_s }, index) => ({
    at: [Math.sin(theta_s) * Math.cos(phi_s), Math.sin(theta_s) * Math.sin(phi_s), Math.cos(theta_s)],
    value: light.reduce((sum, part, column) => sum + Number(matrices[index][column]) * part, 0),
  }));
}
