// Elements, made in one call.

/** An element `tag` with attributes (a function becomes a listener) and children. */
export function make(tag, attributes = {}, ...children) {
  return dress(document.createElement(tag), attributes, children);
}

/** An element of a drawing. */
export function draw(tag, attributes = {}, ...children) {
  return dress(document.createElementNS("http://www.w3.org/2000/svg", tag), attributes, children);
}

/** A labelled choice: `options` are texts, or [value, text]. */
export function choice(label, options, value, chosen) {
  const select = make("select", { onchange: () => chosen(select.value) });
  for (const option of options) {
    const [key, text] = Array.isArray(option) ? option : [option, option];
    select.append(make("option", { value: key, selected: String(key) === String(value) }, text));
  }
  return make("label", {}, `${label} `, select);
}

/** A labelled number field. */
export function number(label, value, changed, attributes = {}) {
  const input = make("input", {
    type: "number", value, ...attributes,
    onchange: () => Number.isFinite(input.valueAsNumber) && changed(input.valueAsNumber),
  });
  return make("label", {}, `${label} `, input);
}

/** A labelled tick box. */
export function tick(label, value, changed) {
  const input = make("input", { type: "checkbox", checked: value, onchange: () => changed(input.checked) });
  return make("label", {}, input, ` ${label}`);
}

/** A labelled slider with its value beside it. */
export function slider(label, value, changed, { unit = "", ...attributes }) {
  const shown = make("output", {}, `${value}${unit}`);
  const input = make("input", {
    type: "range", value, ...attributes,
    oninput: () => {
      shown.textContent = `${input.value}${unit}`;
      changed(input.valueAsNumber);
    },
  });
  return make("label", {}, `${label} `, input, " ", shown);
}

function dress(element, attributes, children) {
  for (const [name, value] of Object.entries(attributes)) {
    if (typeof value === "function") element.addEventListener(name.slice(2), value);
    else if (value === true) element.setAttribute(name, "");
    else if (value !== false && value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children);
  return element;
}
