// How far the replay is. Everything that shows the mission listens to it.

export type Effort = "views" | "metres" | "seconds";
export const kEfforts: [Effort, string][] =
  [["views", "Views"], ["metres", "Metres"], ["seconds", "Seconds"]];

export class Clock {
  effort: Effort = "views";
  at = 0; // in the unit of `effort`; below 0: after the profile, before whatever counts
  isPlaying = false;
  private readonly listeners: (() => void)[] = [];

  onChange(listener: () => void) { this.listeners.push(listener); }

  set(change: Partial<Pick<Clock, "effort" | "at" | "isPlaying">>) {
    Object.assign(this, change);
    for (const listener of this.listeners) listener();
  }
}
