// The state of the page; the part of the address after # holds it, so that a link shares it.

const START = {
  input: "model",
  view: "ball",
  model: "Shadowed_Facet_BRDF_Model",
  parameters: {
    substrate: "gold.nk",
    sdf: "Gaussian_Slope_Distribution_Function",
    "sdf.s": "0.25",
    shadow: "Smith_Shadow_Function",
    "shadow.w": "0.177",
  },
  program: "",
  files: {},
  compat: false,
  thetai: 45,
  thetas: 45,
  phis: 0,
  incident: "unpolarized",
  illuminant: "D65",
  exposure: 1,
  angle: 0,
  light: 40,
  log: false,
  quantity: "factor",
  cosine: false,
};

const listeners = [];

/** The one state. Change it with `set`. */
export const state = { ...START, ...read() };

/** Changes values, stores them in the address and notifies the listeners. */
export function set(changes) {
  Object.assign(state, changes);
  history.replaceState(null, "", `#${write()}`);
  const names = new Set(Object.keys(changes));
  for (const listener of listeners) listener(names);
}

/** Calls `listener` with the names of changed values. */
export function onChange(listener) {
  listeners.push(listener);
}

/** Light sources by name: their Stokes vectors (I, Q, U, V), Q > 0 is s-polarized. */
export const INCIDENT = {
  unpolarized: [1, 0, 0, 0],
  "s-polarized": [1, 1, 0, 0],
  "p-polarized": [1, -1, 0, 0],
  "+45°": [1, 0, 1, 0],
  "−45°": [1, 0, -1, 0],
  "left circular": [1, 0, 0, 1],
  "right circular": [1, 0, 0, -1],
};

/** The first material needs a data file, which the service provides. */
export async function begin() {
  const name = "gold.nk";
  if (state.parameters.substrate !== name || name in state.files) return;
  const response = await fetch(`page/${name}`);
  state.files = { ...state.files, [name]: await response.text() };
}

/** The material as the service expects it. */
export function material() {
  if (state.input === "program") {
    return { program: state.program, files: state.files, compat: state.compat };
  }
  return { model: state.model, parameters: Object.entries(state.parameters), files: state.files };
}

/** The address contains only the values that differ from the start. */
function write() {
  const changed = Object.entries(state).filter(
    ([name, value]) => JSON.stringify(value) !== JSON.stringify(START[name]),
  );
  const bytes = new TextEncoder().encode(JSON.stringify(Object.fromEntries(changed)));
  return btoa(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
}

function read() {
  try {
    const bytes = Uint8Array.from(atob(location.hash.slice(1)), (c) => c.charCodeAt(0));
    const found = JSON.parse(new TextDecoder().decode(bytes));
    return Object.fromEntries(Object.entries(found).filter(([name]) => name in START));
  } catch {
    return {};
  }
}
