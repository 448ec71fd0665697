// How much of a picture is drawn: where a whole one takes long, only the gist while things move.
// The renderers of machines without a graphics card take seconds for what others do in
// milliseconds: only the first whole picture tells.

const kFluent_ms = 50; // a whole picture that takes no longer is drawn at every step
const kRest_ms = 600; // after the last change, at least, the whole one follows

export class Detail {
  isWhole = false; // what is to be drawn now
  readonly drawnSoFar = { whole: 0, gist: 0 };
  private wholeTook_ms = Infinity;
  private timer = 0;

  constructor(private readonly redraw: () => void) {}

  /** Before a picture of something that has changed. */
  change() { this.isWhole = this.wholeTook_ms <= kFluent_ms; }

  /** After a picture that took that long. */
  drawn(took_ms: number) {
    clearTimeout(this.timer);
    ++this.drawnSoFar[this.isWhole ? "whole" : "gist"];
    if (this.isWhole) {
      this.wholeTook_ms = took_ms;
      return;
    }
    this.timer = window.setTimeout(() => {
      this.isWhole = true;
      this.redraw();
    }, Math.max(kRest_ms, 3 * took_ms));
  }
}
