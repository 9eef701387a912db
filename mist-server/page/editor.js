// The text of a program, with its errors marked at their lines.

import { make } from "./dom.js";

/** An editor that calls `changed` with its text and `run` on Ctrl+Enter. */
export class Editor {
  constructor(text, changed, run) {
    this.numbers = make("pre", { "aria-hidden": "true" });
    this.area = make("textarea", {
      id: "program", spellcheck: "false", "aria-label": "Program",
      oninput: () => {
        this.mark([]);
        changed(this.area.value);
      },
      onscroll: () => { this.numbers.scrollTop = this.area.scrollTop; },
      onkeydown: (event) => event.key === "Enter" && (event.ctrlKey || event.metaKey) && run(),
    });
    this.area.value = text;
    this.list = make("ul", { class: "marks", role: "alert" });
    this.element = make("div", {}, make("div", { class: "editor" }, this.numbers, this.area), this.list);
    this.mark([]);
  }

  /** The text. */
  get text() {
    return this.area.value;
  }

  set text(text) {
    this.area.value = text;
    this.mark([]);
  }

  /** Shows errors {line, column, message, help}; a click moves the cursor to the place. */
  mark(errors) {
    const wrong = new Set(errors.map((error) => error.line));
    const count = this.text.split("\n").length;
    const each = Array.from({ length: count }, (_, at) =>
      make("div", wrong.has(at + 1) ? { class: "wrong" } : {}, String(at + 1)));
    this.numbers.replaceChildren(...each);
    this.list.replaceChildren(...errors.map((error) => {
      const help = error.help ? ` — ${error.help}` : "";
      const text = `${error.line}:${error.column} ${error.message}${help}`;
      return make("li", {}, make("button", { type: "button", onclick: () => this.go(error) }, text));
    }));
  }

  /** Moves the cursor to a place. */
  go({ line, column }) {
    const before = this.text.split("\n").slice(0, line - 1);
    const at = before.reduce((sum, one) => sum + one.length + 1, 0) + column - 1;
    this.area.focus();
    this.area.setSelectionRange(at, at + 1);
    this.area.scrollTop = Math.max(0, (line - 5) * parseFloat(getComputedStyle(this.area).lineHeight));
  }
}
