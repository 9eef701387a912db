// Requests of the page to the service. Every refusal becomes a `Problem`.

/** A failed request: `application/problem+json`, or no response. */
export class Problem extends Error {
  constructor(status, body) {
    const text = body.message ?? body.detail ?? body.title ?? `the service answered ${status}`;
    super(body.help ? `${text}\n${body.help}` : text);
    this.status = status;
    /** Places in a program: [{line, column, message, help}]. */
    this.marks = body.diagnostics ?? (body.line ? [body] : []);
  }
}

const KEY = "key";

/** The key of the service, if it requires one; stored until the tab is closed, not part of links. */
export const key = {
  get: () => sessionStorage.getItem(KEY) ?? "",
  set: (text) => sessionStorage.setItem(KEY, text),
};

async function ask(path, options = {}) {
  const headers = key.get() ? { ...options.headers, Authorization: `Bearer ${key.get()}` } : options.headers;
  let response;
  try {
    response = await fetch(path, { ...options, headers });
  } catch (error) {
    if (error.name === "AbortError") throw error;
    throw new Problem(0, { message: "the service does not answer" });
  }
  if (response.ok) return response;
  const text = await response.text();
  let body;
  try {
    body = JSON.parse(text);
  } catch {
    body = { message: text || `the service answered ${response.status}` };
  }
  throw new Problem(response.status, body);
}

const posted = (body, signal, headers = {}) => ({
  method: "POST",
  headers: { "Content-Type": "application/json", ...headers },
  body: JSON.stringify(body),
  signal,
});

/** The registry: families of classes with their parameters. */
export const models = async () => (await ask("v1/models")).json();

/** Mueller matrices of {model, parameters, files, geometries}, angles in radians. */
export const evaluate = async (request, signal) =>
  (await (await ask("v1/evaluate", posted(request, signal))).json()).mueller;

/** Diagnostics of {program, files, compat}: [{line, column, message, help}]. */
export const check = async (request, signal) =>
  (await (await ask("v1/check", posted(request, signal))).json()).diagnostics;

/** Starts a job of {program, files, compat}; its id. */
export const start = async (request) =>
  (await (await ask("v1/jobs", posted(request))).json()).id;

/** Stops a job. */
export const stop = (id) => ask(`v1/jobs/${id}`, { method: "DELETE" });

/** A text that a job wrote: "results", "samples" or "listing". */
export const jobText = async (id, what) => (await ask(`v1/jobs/${id}/${what}`)).text();

/** Calls `told` with every state of the job until it has ended; returns the last state. */
export async function follow(id, told) {
  const response = await ask(`v1/jobs/${id}/events`);
  const reader = response.body.pipeThrough(new TextDecoderStream()).getReader();
  let text = "";
  let state = null;
  for (;;) {
    const { done, value } = await reader.read().catch(() => ({ done: true }));
    if (done) break;
    const events = (text + value).split("\n\n");
    text = events.pop();
    for (const event of events) {
      const data = event.split("\n").find((line) => line.startsWith("data:"));
      if (data) told((state = JSON.parse(data.slice("data:".length))));
    }
  }
  if (state && !["queued", "running"].includes(state.state)) return state;
  throw new Problem(0, { message: "the connection to the service was lost while the job ran" });
}

/** Colours of a material at text rows `thetai thetas phis point`: the table as JSON. */
export function integrate(material, rows, query, signal) {
  const path = (name) => `v1/materials/${name}/integrate?${new URLSearchParams(query)}`;
  const headers = { "Content-Type": "application/x-mist", Accept: "application/json" };
  const request = { method: "POST", headers, body: rows, signal };
  return withMaterial(material, async (name) => (await ask(path(name), request)).json());
}

/** A table of a material by its file name and query, such as `table.mspd`. */
export function table(material, file, query, signal) {
  const path = (name) => `v1/materials/${name}/${file}?${new URLSearchParams(query)}`;
  return withMaterial(material, async (name) => {
    const response = await ask(path(name), { signal });
    return file.endsWith(".json") ? response.json() : response.text();
  });
}

const known = new Set();

/** Calls `wanted` with the name of the stored `material`; stores it again if the service has deleted it. */
async function withMaterial(material, wanted) {
  const text = JSON.stringify(material);
  const name = `page-${digest(text)}`;
  const put = async () => {
    const headers = { "Content-Type": "application/json" };
    await ask(`v1/materials/${name}`, { method: "PUT", headers, body: text });
    known.add(name);
  };
  if (!known.has(name)) await put();
  try {
    return await wanted(name);
  } catch (error) {
    if (error.status !== 404) throw error;
    await put();
    return wanted(name);
  }
}

/** FNV-1a of 53 bits: equal materials have equal names. */
function digest(text) {
  let hash = 0xcbf29ce484222325n;
  for (const byte of new TextEncoder().encode(text)) {
    hash = ((hash ^ BigInt(byte)) * 0x100000001b3n) & 0xffffffffffffffffn;
  }
  return hash.toString(16).padStart(16, "0");
}
