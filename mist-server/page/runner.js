// Runs programs as jobs of the service, with progress and cancellation.

import { Problem, follow, jobText, start, stop } from "./api.js";

const ENDED = { done: "Done.", failed: "The run failed.", cancelled: "Cancelled." };

/** One run at a time: its buttons, its progress and its results. */
export class Runner {
  constructor({ run, cancel, progress, status }, finished, refused) {
    Object.assign(this, { run, cancel, progress, status, finished, refused });
    /** The id of the last job. */
    this.job = null;
    /** The table of the last job that was done. */
    this.results = null;
    cancel.addEventListener("click", () => this.job && stop(this.job).catch(refused));
  }

  /** Runs {program, files, compat} and waits for the end. */
  async go(request) {
    if (this.run.disabled) return;
    this.busy(true);
    this.progress.value = 0;
    this.status.textContent = "Sent …";
    this.job = null;
    try {
      this.job = await start(request);
      const last = await follow(this.job, (state) => this.tell(state));
      this.status.textContent = ENDED[last.state];
      if (last.state === "failed") throw new Problem(last.problem.status, last.problem);
      if (last.state === "done") {
        this.results = await jobText(this.job, "results");
        this.finished();
      }
    } catch (error) {
      if (!this.job) this.status.textContent = "Refused.";
      this.refused(error);
    } finally {
      this.busy(false);
    }
  }

  tell({ state, progress }) {
    this.progress.value = state === "done" ? 1 : progress ?? 0;
    this.status.textContent = `${state} ${Math.round(100 * this.progress.value)} %`;
  }

  busy(is) {
    this.run.disabled = is;
    this.cancel.disabled = !is;
  }
}
