// Data files of the material, stored in the state and therefore in links.

import { make } from "./dom.js";
import { set, state } from "./state.js";

/** Wires the list and the field for new files. */
export function files(list, input, failed) {
  input.addEventListener("change", async () => {
    try {
      const texts = await Promise.all([...input.files].map(async (file) => [file.name, await file.text()]));
      set({ files: { ...state.files, ...Object.fromEntries(texts) } });
    } catch (error) {
      failed(error);
    }
    input.value = "";
    fill(list);
  });
  fill(list);
}

function fill(list) {
  list.replaceChildren(...Object.entries(state.files).map(([name, text]) => {
    const remove = () => {
      const { [name]: _, ...rest } = state.files;
      set({ files: rest });
      fill(list);
    };
    return make("li", {}, `${name}, ${text.length} characters `,
      make("button", { type: "button", onclick: remove, "aria-label": `Remove ${name}` }, "×"));
  }));
}
