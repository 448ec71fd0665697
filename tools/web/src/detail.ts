// How much of a picture is drawn: where a whole one takes long, only the gist while things move.
// The renderers of machines without a graphics card take seconds for what others do in
// milliseconds: only the first whole picture tells.

const kFluent_ms = 50; // a whole picture that takes no longer is drawn at every step
const kRest_ms = 600; // after the last change was to be seen, at least, the whole one follows

export class Detail {
  isWhole = false; // what is to be drawn now
  private wholeTook_ms: number | null = null;
  private timer = 0;
  readonly drawnSoFar = { whole: 0, gist: 0 };
  private pictures = 0;

  constructor(private readonly redraw: () => void) {}

  /** Before a picture of something that has changed. */
  change() { this.isWhole = this.wholeTook_ms !== null && this.wholeTook_ms <= kFluent_ms; }

  /** After a picture that took that long. */
  drawn(took_ms: number) {
    clearTimeout(this.timer);
    ++this.drawnSoFar[this.isWhole ? "whole" : "gist"];
    if (this.isWhole) {
      this.wholeTook_ms = took_ms;
      return;
    }
    const picture = ++this.pictures;
    const begin = performance.now();
    // the frame after the next one waits for the renderer, however slow that is
    requestAnimationFrame(() => requestAnimationFrame(() => {
      if (picture !== this.pictures) return;
      const rest_ms = Math.max(kRest_ms, 3 * (performance.now() - begin));
      this.timer = window.setTimeout(() => this.rest(), rest_ms);
    }));
  }

  /** Now, whatever it takes: for a picture that is kept. */
  insist() {
    clearTimeout(this.timer);
    this.isWhole = true;
  }

  private rest() {
    this.insist();
    this.redraw();
  }
}
