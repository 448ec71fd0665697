// How far the replay is, and what moves it. Everything that shows the mission listens to it.
import { MathUtils } from "three";
import { lastAtMost, type Flight } from "./flight";

export type Effort = "views" | "metres" | "seconds" | "metres_with_profile"
  | "seconds_with_profile" | "wh_with_profile";
/** In the order of figures. */
export const kEfforts: [Effort, string][] =
  [["views", "Views"], ["metres", "Metres"], ["seconds", "Seconds"],
    ["metres_with_profile", "From take-off: m"], ["seconds_with_profile", "s"],
    ["wh_with_profile", "Wh"]];

/** A whole replay at speed 1: half a second a view, but neither a flash nor an evening. */
const replayLasts_s = (views: number) => MathUtils.clamp(0.5 * views, 8, 60);

export class Clock {
  effort: Effort = "views";
  at = 0; // in the unit of `effort`; at begin(): after the profile, before whatever counts
  isPlaying = false;
  speed = 1;
  private frame = 0; // that is asked for while it plays
  private flights: Flight[] = [];
  private readonly listeners: (() => void)[] = [];

  onChange(listener: () => void) { this.listeners.push(listener); }

  setFlights(flights: Flight[]) {
    this.flights = flights;
    this.effort = this.known(this.effort);
    this.set({ at: MathUtils.clamp(this.at, this.begin(), this.last()) });
  }

  /**
   * Metres and seconds may be as many after the profile as at the first view, so that the moment
   * before has a place of its own, so much before: a hundredth of the mission.
   */
  room(effort: Effort = this.effort): number {
    return effort === "views" ? 0 : Math.max(0.01 * this.last(effort), 1e-3);
  }

  /** After the profile, of the first run to end it. */
  begin(effort: Effort = this.effort): number {
    const ends = this.flights.map((flight) => flight.effort(0, effort));
    return Math.min(this.last(effort), ...ends) - this.room(effort);
  }

  /** Of all runs. */
  knows(effort: Effort): boolean { return this.flights.every((flight) => flight.knows(effort)); }

  /** Of the longest run. */
  last(effort: Effort = this.effort): number {
    return Math.max(0, ...this.flights.map((flight) => flight.last(effort)));
  }

  /** The same moment of the first run, measured otherwise. */
  setEffort(wanted: Effort) {
    const effort = this.known(wanted);
    const [lead] = this.flights;
    const n = lead?.n ?? 0;
    this.set({ effort, at: n > 0 ? lead.effort(n, effort) : this.begin(effort), isPlaying: false });
  }

  moveTo(at: number) {
    this.set({ at: MathUtils.clamp(at, this.begin(), this.last()), isPlaying: false });
  }

  /** After the first `n` views. */
  seek(n: number) {
    this.setEffort("views");
    this.moveTo(n);
  }

  /** To the next or an earlier view of any run. */
  step(views: number) {
    const all = this.flights.flatMap((flight) => Array.from(
      { length: flight.count }, (_, n) => flight.effort(n + 1, this.effort)));
    const stops = [...new Set([this.begin(), ...all])].sort((a, b) => a - b);
    const here = lastAtMost(stops, this.at + 1e-9);
    this.moveTo(stops[MathUtils.clamp(here + views, 0, stops.length - 1)]);
  }

  /** Plays, or rests at a view, not between two. */
  toggle() {
    if (this.isPlaying) {
      this.moveTo(this.effort === "views" ? Math.floor(this.at + 1e-9) : this.at);
      return;
    }
    this.set({ isPlaying: true, at: this.at >= this.last() ? this.begin() : this.at });
    let before = performance.now();
    const advance = (now: number) => {
      if (!this.isPlaying) return;
      const share = this.speed * (now - before) / 1000 / replayLasts_s(this.last("views"));
      const at = this.at + share * this.last();
      before = now;
      this.set({ at: Math.min(at, this.last()), isPlaying: at < this.last() });
      this.frame = requestAnimationFrame(advance);
    };
    cancelAnimationFrame(this.frame);
    this.frame = requestAnimationFrame(advance);
  }

  private known(effort: Effort): Effort { return this.knows(effort) ? effort : "views"; }

  private set(change: Partial<Pick<Clock, "effort" | "at" | "isPlaying">>) {
    Object.assign(this, change);
    for (const listener of this.listeners) listener();
  }
}
