// A sphere of the material under one lamp, without and with a polarizing filter.
//
// The distant camera looks along −z, so every pixel has one direction of incidence and one
// of scattering; the service gives its colour and its Stokes components, and the filter is arithmetic:
// behind a filter at the angle a from s the light is (I + Q cos 2a + U sin 2a)/2.

import { integrate } from "./api.js";
import { choice, make, slider } from "./dom.js";
import { encoded } from "./pixels.js";
import { LAMBDA } from "./spectrum.js";
import { set, state } from "./state.js";
import { cross, dot, minus, times, unit } from "./vector.js";

const SIZE = 144;
/** Radius of the sphere, in units of half the picture. */
const RADIUS = 0.95;
const VIEW = [0, 0, 1];
const GROUND = [24, 25, 28];
const COLOURS = ["R", "G", "B"];

/** The view: two pictures and the controls of light and filter. */
export async function show(place, material, signal) {
  const plain = make("canvas", { width: SIZE, height: SIZE, id: "ball-plain" });
  const filtered = make("canvas", { width: SIZE, height: SIZE, id: "ball-filtered" });
  const paint = () => scene && (fill(plain, scene, null), fill(filtered, scene, state.angle));
  let scene = null;
  place.replaceChildren(
    make("div", { class: "controls" },
      slider("lamp", state.light, (light) => set({ light }), { min: 0, max: 80, step: 5, unit: "°" }),
      choice("illuminant", ["D65", "D50", "A", "FL2", "FL11"], state.illuminant, (illuminant) => set({ illuminant })),
      slider("exposure", state.exposure, (exposure) => { set({ exposure }); paint(); },
        { min: 0.1, max: 4, step: 0.1 })),
    make("div", { class: "pair" },
      make("figure", {}, plain, make("figcaption", {}, "Without a filter")),
      make("figure", {}, filtered,
        make("figcaption", {}, "Behind a linear polarizer",
          make("div", {}, slider("axis", state.angle, (angle) => { set({ angle }); paint(); },
            { min: 0, max: 180, step: 1, unit: "°", id: "filter-angle" })),
          "0° transmits horizontal light; the scale is the same on both sides"))));
  scene = await look(material, signal);
  paint();
}

/** The pixels that show the sphere, with their colours. */
async function look(material, signal) {
  const lamp = (state.light * Math.PI) / 180;
  const source = unit([-Math.sin(lamp) * 0.6, Math.sin(lamp) * 0.8, Math.cos(lamp)]);
  const pixels = visible(source);
  const rows = pixels.map(({ angles }) => `${angles.join(" ")} point`).join("\n");
  const query = { lambda: LAMBDA, illuminant: state.illuminant, space: "rec709", stokes: 1, quantity: "factor" };
  const { columns, rows: colours } = await integrate(material, rows, query, signal);
  const places = ["", "Q", "U"].map((part) => COLOURS.map((name) => columns.indexOf(name + part)));
  return pixels.map((pixel, index) => {
    const [intensity, q, u] = places.map((part) => part.map((at) => colours[index][at]));
    return { ...pixel, intensity, q, u };
  });
}

/** The pixels that the lamp reaches: place, angles of the models in degrees, cosine, turn of s. */
function visible(source) {
  const found = [];
  for (let row = 0; row < SIZE; row += 1) {
    for (let column = 0; column < SIZE; column += 1) {
      const [x, y] = middle(row, column);
      const height = RADIUS ** 2 - x * x - y * y;
      if (height <= 0) continue;
      const normal = unit([x, y, Math.sqrt(height)]);
      const cosine = dot(normal, source);
      if (cosine > 0.01 && dot(normal, VIEW) > 0.02) found.push(pixel(row, column, normal, source, cosine));
    }
  }
  return found;
}

/** The middle of a pixel. */
const middle = (row, column) => [(2 * (column + 0.5)) / SIZE - 1, 1 - (2 * (row + 0.5)) / SIZE];

function pixel(row, column, normal, source, cosine) {
  // In the models the light comes from −x.
  const along = unit(minus(times(normal, cosine), source)) ?? unit(cross([0, 1, 0], normal));
  const across = cross(normal, along);
  const phi = Math.atan2(dot(VIEW, across), dot(VIEW, along));
  const degrees = (radians) => Number(((radians * 180) / Math.PI).toFixed(4));
  const angles = [degrees(Math.acos(Math.min(1, cosine))), degrees(Math.acos(Math.min(1, dot(normal, VIEW)))), degrees(phi)];
  const s = unit(cross(normal, VIEW)) ?? across;
  return { row, column, angles, cosine, turn: Math.atan2(s[1], s[0]) };
}

/** Paints the scene; `filter` is the angle of a filter in degrees, counter-clockwise from x. */
function fill(canvas, scene, filter) {
  const context = canvas.getContext("2d");
  const image = context.createImageData(SIZE, SIZE);
  // Pixels without light of the lamp are black.
  for (let at = 0; at < SIZE * SIZE; at += 1) {
    const isBall = Math.hypot(...middle(Math.floor(at / SIZE), at % SIZE)) < RADIUS;
    image.data.set([...(isBall ? [0, 0, 0] : GROUND), 255], 4 * at);
  }
  for (const { row, column, cosine, turn, intensity, q, u } of scene) {
    const angle = filter === null ? 0 : 2 * ((filter * Math.PI) / 180 - turn);
    const light = intensity.map((i, channel) =>
      filter === null ? i : (i + q[channel] * Math.cos(angle) + u[channel] * Math.sin(angle)) / 2);
    const bytes = light.map((value) => encoded(value * cosine * state.exposure));
    image.data.set(bytes, 4 * (row * SIZE + column));
  }
  context.putImageData(image, 0, 0);
}
