// The scattering hemisphere with points coloured by their BRDF or intensity; it can be rotated.

import { jobText } from "./api.js";
import { short } from "./chart.js";
import { choice, make, number, tick } from "./dom.js";
import { ofModel, parse } from "./samples.js";
import { INCIDENT, set, state } from "./state.js";

const SIZE = 520;
const DECADES = 5;
const turn = { around: -0.6, over: 0.9 };

/** The view: of the last run's samples in the tab Program, of a grid in the tab Model. */
export async function show(place, material, signal, job) {
  const kind = choice("shown", [["", "BRDF"], ["1", "intensity: BRDF · cos θs"]], state.cosine ? "1" : "",
    (value) => set({ cosine: value === "1" }));
  const log = tick("logarithmic", state.log, (value) => set({ log: value }));
  const controls = make("div", { class: "controls" }, kind, log);
  if (material.model) {
    controls.append(
      number("θi °", state.thetai, (thetai) => set({ thetai }), { min: 0, max: 89, step: 1 }),
      choice("light", Object.keys(INCIDENT), state.incident, (incident) => set({ incident })));
  }
  place.replaceChildren(controls);
  const points = material.model ? await ofModel(material, signal) : await ofRun(job);
  if (!points.length) {
    place.append(make("p", { class: "quiet" },
      "No samples yet: name a file for them in the section FILES of the program (samples = points.txt) and run it."));
    return;
  }
  const values = points.map(({ at, value }) => (state.cosine ? value * at[2] : value));
  place.append(globe(points, values, Boolean(material.model)), scale(values));
}

async function ofRun(job) {
  if (!job) return [];
  try {
    return parse(await jobText(job, "samples"));
  } catch (error) {
    if (error.status === 404) return [];
    throw error;
  }
}

function globe(points, values, isModel) {
  const most = highest(values);
  const colours = values.map((value) => ramp(part(value, most)));
  const canvas = make("canvas", {
    width: SIZE, height: SIZE * 0.9, id: "hemisphere", tabindex: 0, role: "img",
    "aria-label": "Scattering hemisphere; arrow keys rotate it",
  });
  const paint = () => drawGlobe(canvas, points, colours, isModel);
  let held = null;
  canvas.addEventListener("pointerdown", (event) => {
    held = [event.clientX, event.clientY];
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointerup", () => { held = null; });
  canvas.addEventListener("pointermove", (event) => {
    if (!held) return;
    rotate(event.clientX - held[0], event.clientY - held[1], paint);
    held = [event.clientX, event.clientY];
  });
  canvas.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: [-10, 0], ArrowRight: [10, 0], ArrowUp: [0, -10], ArrowDown: [0, 10] }[event.key];
    if (!step) return;
    event.preventDefault();
    rotate(...step, paint);
  });
  paint();
  return canvas;
}

function rotate(x, y, paint) {
  turn.around += x / 120;
  turn.over = Math.min(Math.PI / 2, Math.max(0, turn.over + y / 120));
  paint();
}

/** Parallel projection after rotations about z and about the horizontal axis of the screen. */
function project([x, y, z]) {
  const [sin, cos] = [Math.sin(turn.around), Math.cos(turn.around)];
  const [side, depth] = [x * cos - y * sin, x * sin + y * cos];
  const up = depth * Math.sin(turn.over) + z * Math.cos(turn.over);
  const radius = SIZE * 0.44;
  return [SIZE / 2 + side * radius, SIZE * 0.48 - up * radius, depth * Math.cos(turn.over) - z * Math.sin(turn.over)];
}

function drawGlobe(canvas, points, colours, isModel) {
  const context = canvas.getContext("2d");
  const ink = getComputedStyle(document.documentElement);
  context.clearRect(0, 0, canvas.width, canvas.height);
  context.strokeStyle = ink.getPropertyValue("--line");
  const circle = (place) => path(context, Array.from({ length: 73 }, (_, at) => place((at * Math.PI) / 36)));
  for (const theta of [30, 60, 90]) {
    const [sin, cos] = [Math.sin((theta * Math.PI) / 180), Math.cos((theta * Math.PI) / 180)];
    circle((phi) => [sin * Math.cos(phi), sin * Math.sin(phi), cos]);
  }
  const far = points.map(({ at }, index) => [project(at), index]).sort((a, b) => b[0][2] - a[0][2]);
  for (const [[x, y], index] of far) {
    context.fillStyle = colours[index];
    context.beginPath();
    context.arc(x, y, 3.2, 0, 2 * Math.PI);
    context.fill();
  }
  if (!isModel) return;
  context.strokeStyle = ink.getPropertyValue("--accent");
  const incident = (state.thetai * Math.PI) / 180;
  path(context, [[-1.15 * Math.sin(incident), 0, 1.15 * Math.cos(incident)], [0, 0, 0]]);
}

function path(context, points) {
  context.beginPath();
  for (const point of points) {
    const [x, y] = project(point);
    context.lineTo(x, y);
  }
  context.stroke();
}

function scale(values) {
  const most = highest(values);
  const least = state.log ? most * 10 ** -DECADES : 0;
  const stops = Array.from({ length: 9 }, (_, at) => ramp(at / 8)).join(",");
  return make("p", { class: "quiet" }, `${short(least)} `,
    make("span", { style: `display:inline-block;width:12rem;height:.7rem;border-radius:3px;background:linear-gradient(90deg,${stops})` }),
    ` ${short(most)} 1/sr, ${values.length} points`);
}

const highest = (values) => values.reduce((most, value) => (value > most ? value : most), 1e-300);

function part(value, most) {
  const share = Math.max(0, value) / most;
  return state.log ? Math.max(0, 1 + Math.log10(Math.max(share, 1e-300)) / DECADES) : share;
}

/** From dark blue over red to yellow; lightness grows with the value. */
function ramp(value) {
  const hue = 250 + 170 * value;
  return `hsl(${hue % 360} 80% ${22 + 50 * value}%)`;
}
