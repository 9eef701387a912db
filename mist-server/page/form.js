// The parameters of a model as a form: a tree, since members have parameters of their own.

import { make } from "./dom.js";

/** The registry by class and by family. */
export class Registry {
  constructor({ families }) {
    this.families = new Map(families.map((family) => [family.base, family.classes]));
    const all = families.flatMap((family) => family.classes);
    this.classes = new Map(all.map((one) => [one.name, one]));
  }

  /** The classes of the family `base`. */
  members(base) {
    return this.families.get(base) ?? [];
  }

  /** Every parameter of `name` in the order in which it is set: [path, parameter, value]. */
  tree(name, values, prefix = "") {
    const parameters = this.classes.get(name)?.parameters ?? [];
    return parameters.flatMap((parameter) => {
      const path = prefix + parameter.name;
      const value = values[path] ?? parameter.default;
      const below = parameter.kind === "member" ? this.tree(value, values, `${path}.`) : [];
      return [[path, parameter, value], ...below];
    });
  }

  /** The `values` of parameters that differ from the defaults, parents before their sub-parameters. */
  clean(name, values) {
    const set = this.tree(name, values).filter(([path, parameter]) =>
      path in values && values[path] !== parameter.default && values[path] !== "");
    return Object.fromEntries(set.map(([path, , value]) => [path, value]));
  }
}

/** The form of `model`; `changed` gets all values that differ from the defaults. */
export function form(registry, model, values, changed) {
  const change = (path, text) => changed(registry.clean(model, { ...values, [path]: text }));
  const fields = (name, prefix) =>
    (registry.classes.get(name)?.parameters ?? []).map((parameter) => {
      const path = prefix + parameter.name;
      const value = values[path] ?? parameter.default;
      const row = field(registry, path, parameter, value, path in values, change);
      if (parameter.kind !== "member") return row;
      return make("div", {}, row, make("fieldset", { "aria-label": path }, ...fields(value, `${path}.`)));
    });
  return make("div", {}, ...fields(model, ""));
}

function field(registry, path, parameter, value, isSet, change) {
  const id = `parameter-${path}`;
  const options = parameter.kind === "member" ? registry.members(parameter.base) : [];
  const input = options.length
    ? make("select", { id, onchange: () => change(path, input.value) },
        ...options.map((one) => make("option", { value: one.name, selected: one.name === value }, one.name)))
    : make("input", { id, value, spellcheck: "false", onchange: () => change(path, input.value.trim()) });
  const unit = parameter.unit && parameter.unit !== "1" ? parameter.unit : "";
  return make("div", { class: isSet ? "parameter set" : "parameter" },
    make("label", { for: id, title: path }, parameter.name),
    input,
    make("span", { class: "unit" }, unit),
    make("span", { class: "help" }, parameter.doc));
}
