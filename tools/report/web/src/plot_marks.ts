// What a plot shows besides its curves: where the paper ended, and when frontier views were chosen.
import type uPlot from "uplot";
import type { Effort } from "./clock";
import { phaseShade, runColour } from "./colours";
import { make } from "./dom";
import type { Flight } from "./flight";
import { frontierPhases, type PlotContent, type Ring } from "./plot_specs";

export const frontierFlights = (flights: Flight[]) =>
  flights.filter((flight) => flight.data.views.sampler.includes("fvs"));

/** What the marks mean, where there are any; `flights`: whose frontier views are marked. */
export function marksKey({ rings }: PlotContent, flights: Flight[]): HTMLElement | null {
  const papers = new Set(rings.map((ring) => ring.label));
  const marks: Node[] = [...papers].map((label) => make("span", {}, `○ paper's end: ${label}`));
  if (frontierFlights(flights).length > 0) {
    const isAlone = flights.length === 1;
    marks.push(make("span", {}, make("i", { class: isAlone ? "swatch" : "swatch strip" }),
      isAlone ? "frontier views (FVS)" : "FVS: when each run chose frontier views"));
  }
  return marks.length > 0 ? make("span", { class: "marks-key" }, ...marks) : null;
}

/** Behind the curves of one run. */
export function shadePhases(plot: uPlot, flights: Flight[], effort: Effort) {
  if (flights.length !== 1) return;
  const { ctx, bbox } = plot;
  ctx.fillStyle = phaseShade();
  for (const [from, to] of frontierPhases(flights[0], effort)) {
    const x = plot.valToPos(from, "x", true);
    ctx.fillRect(x, bbox.top, Math.max(1, plot.valToPos(to, "x", true) - x), bbox.height);
  }
}

/**
 * A lane a run above the curves, which no curve enters: bars where it chose frontier views, as wide
 * as the axis, which ends at `last`.
 */
export function makeLanes(flights: Flight[], effort: Effort, last: number): HTMLElement {
  const share = (at: number) => 100 * Math.min(1, at / last);
  const lanes = make("div", { class: "phase-lanes" });
  flights.forEach((flight) => {
    const lane = make("div", { class: "phase-lane", title: `${flight.data.label}: when it chose `
      + "frontier views (FVS)" });
    for (const [from, to] of frontierPhases(flight, effort)) {
      const bar = make("i");
      bar.style.left = `${share(from)}%`;
      bar.style.width = `max(2px, ${share(to) - share(from)}%)`;
      bar.style.background = runColour(flight.index);
      lane.append(bar);
    }
    lanes.append(lane);
  });
  return lanes;
}

export function drawRings(plot: uPlot, rings: Ring[]) {
  const { ctx } = plot;
  for (const ring of rings) {
    ctx.beginPath();
    ctx.lineWidth = 1.6 * devicePixelRatio;
    ctx.strokeStyle = ring.colour;
    ctx.arc(plot.valToPos(ring.x, "x", true), plot.valToPos(ring.y, "y", true),
      5 * devicePixelRatio, 0, 2 * Math.PI);
    ctx.stroke();
  }
}
