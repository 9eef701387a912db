// The page: inputs on the left, views on the right, one state between them.

import { check, key, models } from "./api.js";
import * as ball from "./ball.js";
import { make } from "./dom.js";
import { Editor } from "./editor.js";
import { files } from "./files.js";
import { Registry, form } from "./form.js";
import * as graph from "./graph.js";
import * as hemisphere from "./hemisphere.js";
import * as lobe from "./lobe.js";
import { PROGRAM } from "./program.js";
import { Runner } from "./runner.js";
import * as spectrum from "./spectrum.js";
import { begin as fill, material, onChange, set, state } from "./state.js";

const element = (id) => document.getElementById(id);

const VIEWS = {
  ball: ["Ball", (place, signal) => ball.show(place, material(), signal)],
  spectrum: ["Spectrum", (place, signal) => spectrum.show(place, material(), signal)],
  lobe: ["Lobe", (place, signal) => lobe.show(place, material(), signal)],
  hemisphere: ["Hemisphere", (place, signal) => hemisphere.show(place, material(), signal, runner.job)],
  graph: ["Graph", (place) => graph.show(place, runner.results)],
};

/** Values whose change needs no new picture, or that repaint it themselves. */
const SILENT = new Set(["exposure", "angle"]);

if (!state.program) state.program = PROGRAM;
const editor = new Editor(state.program, typed, () => run());
const runner = new Runner(
  { run: element("run"), cancel: element("cancel"), progress: element("progress"), status: element("status") },
  () => set({ view: state.view === "hemisphere" ? "hemisphere" : "graph" }),
  refused);

const request = () => ({ program: editor.text, files: state.files, compat: state.compat });

function run() {
  editor.mark([]);
  clear();
  runner.go(request());
}

let checking = null;
/** Stores a program and marks its errors when typing pauses. */
function typed(program) {
  checking?.abort();
  checking = new AbortController();
  const { signal } = checking;
  later(async () => {
    set({ program });
    try {
      const found = await check(request(), signal);
      if (!signal.aborted) editor.mark(found);
    } catch (error) {
      if (!signal.aborted) refused(error);
    }
  });
}

/** Shows an error, at its place if it has one. */
function refused(error) {
  editor.mark(error.marks ?? []);
  const problem = element("problem");
  problem.textContent = error.message ?? String(error);
  problem.hidden = false;
}

function clear() {
  element("problem").hidden = true;
}

let waiting = null;
/** Calls `work` when typing pauses. */
function later(work) {
  clearTimeout(waiting);
  waiting = setTimeout(work, 400);
}

let asked = null;
/** Shows the chosen view; an earlier one that is not ready is cancelled. */
async function show() {
  asked?.abort();
  asked = new AbortController();
  const { signal } = asked;
  const place = make("div", {});
  element("view").replaceChildren(place);
  element("view").setAttribute("aria-busy", "true");
  clear();
  try {
    await VIEWS[state.view][1](place, signal);
    if (!signal.aborted) element("view").setAttribute("aria-busy", "false");
  } catch (error) {
    if (signal.aborted) return;
    element("view").setAttribute("aria-busy", "false");
    refused(error);
  }
}

/** Tabs, chosen by click or arrow key. */
function tabs(list, chosen) {
  const mark = () => {
    for (const tab of list) {
      const on = tab.dataset.name === chosen();
      tab.setAttribute("aria-selected", String(on));
      tab.tabIndex = on ? 0 : -1;
    }
  };
  list.forEach((tab, at) => tab.addEventListener("keydown", (event) => {
    const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
    if (!step) return;
    const next = list[(at + step + list.length) % list.length];
    next.focus();
    next.click();
  }));
  onChange(mark);
  mark();
}

function drawForm(registry) {
  const focused = document.activeElement?.id;
  const changed = (parameters) => set({ parameters });
  element("parameters").replaceChildren(form(registry, state.model, state.parameters, changed));
  element("summary").textContent = registry.classes.get(state.model)?.summary ?? "";
  if (focused) document.getElementById(focused)?.focus();
}

function drawInput() {
  element("panel-model").hidden = state.input !== "model";
  element("panel-program").hidden = state.input !== "program";
}

async function begin() {
  const dark = matchMedia("(prefers-color-scheme: dark)").matches;
  document.documentElement.dataset.theme = localStorage.getItem("theme") ?? (dark ? "dark" : "light");
  element("theme").addEventListener("click", () => {
    const theme = document.documentElement.dataset.theme === "dark" ? "light" : "dark";
    document.documentElement.dataset.theme = theme;
    localStorage.setItem("theme", theme);
  });
  element("share").addEventListener("click", async () => {
    set({});
    await navigator.clipboard?.writeText(location.href).catch(() => {});
    element("share").textContent = "Copied";
    setTimeout(() => { element("share").textContent = "Copy link"; }, 1500);
  });
  // The address of the open page has changed.
  addEventListener("hashchange", () => location.reload());
  element("key").value = key.get();
  element("key").addEventListener("change", () => {
    key.set(element("key").value.trim());
    location.reload();
  });
  element("editor").append(editor.element);
  element("run").addEventListener("click", run);
  element("compat").checked = state.compat;
  element("compat").addEventListener("change", (event) => set({ compat: event.target.checked }));
  await fill();
  files(element("file-list"), element("file-input"), refused);

  for (const [name, [title]] of Object.entries(VIEWS)) {
    element("views").append(make("button", {
      role: "tab", type: "button", id: `view-${name}`, "data-name": name, "aria-controls": "view",
      onclick: () => set({ view: name }),
    }, title));
  }
  tabs([...element("views").children], () => state.view);
  const inputs = ["model", "program"].map((name) => element(`tab-${name}`));
  inputs.forEach((tab) => {
    tab.dataset.name = tab.id.slice(4);
    tab.addEventListener("click", () => set({ input: tab.dataset.name }));
  });
  tabs(inputs, () => state.input);
  drawInput();

  const registry = new Registry(await models());
  for (const { name } of registry.members("BRDF_Model")) {
    element("model").append(make("option", { value: name, selected: name === state.model }, name));
  }
  element("model").addEventListener("change", () => set({ model: element("model").value, parameters: {} }));
  drawForm(registry);
  onChange((names) => {
    if (names.has("input")) drawInput();
    if (names.has("model") || names.has("parameters")) drawForm(registry);
    if ([...names].some((name) => !SILENT.has(name))) show();
  });
  await show();
}

begin().catch(refused);
