// The spectrum in one direction, and its colour under several illuminants.

import { table } from "./api.js";
import { lines, short } from "./chart.js";
import { choice, make, number } from "./dom.js";
import { encoded } from "./pixels.js";
import { set, state } from "./state.js";

const LIGHTS = ["D65", "D50", "A", "FL2", "FL11", "LED-B3"];
export const LAMBDA = "380:10:780";

/** The view. */
export async function show(place, material, signal) {
  const angle = (label, name, min, max) =>
    number(label, state[name], (value) => set({ [name]: value }), { min, max, step: 1 });
  place.replaceChildren(make("div", { class: "controls" },
    angle("θi °", "thetai", 0, 89), angle("θs °", "thetas", 0, 89), angle("φs °", "phis", -180, 180),
    choice("quantity", [["factor", "radiance factor"], ["brdf", "BRDF 1/sr"]], state.quantity,
      (quantity) => set({ quantity }))));
  const { quantity } = state;
  const patches = `${state.thetai} ${state.thetas} ${state.phis} point`;
  const query = { patches, lambda: LAMBDA, quantity };
  const text = await table(material, "table.mspd", { ...query, digits: 9 }, signal);
  const row = text.split("\n").find((line) => line && !line.startsWith("#")).split(" ").map(Number);
  const columns = text.match(/^# columns (.*)$/m)[1].split(" ");
  const points = columns.map((name, at) => [Number(name), row[at]]).filter(([nm]) => Number.isFinite(nm));
  place.append(lines([{ name: "spectrum", points }], {
    x: "wavelength, nm", y: quantity === "factor" ? "radiance factor" : "BRDF, 1/sr",
  }));
  const swatches = make("div", { class: "swatches" });
  place.append(swatches);
  const colours = await Promise.all(LIGHTS.map(async (illuminant) => {
    const { columns: names, rows } = await table(material, "table.json", { ...query, illuminant }, signal);
    return ["R", "G", "B"].map((name) => rows[0][names.indexOf(name)]);
  }));
  // A highlight is brighter than a screen: the swatches share one scale, so that none is clipped.
  const white = quantity === "factor" ? 1 : 1 / Math.PI;
  const scale = 1 / Math.max(white, ...colours.flat());
  colours.forEach((rgb, at) => {
    const [r, g, b] = rgb.map((linear) => encoded(linear * scale));
    swatches.append(make("div", { class: "swatch" },
      make("i", { style: `background:rgb(${r},${g},${b})`, title: rgb.map((c) => c.toFixed(4)).join(" ") }),
      LIGHTS[at]));
  });
  place.append(make("p", { class: "quiet" }, `Swatches show ${short(scale * white)} of the light of a white sample.`));
}
