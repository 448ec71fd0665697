// How the page is laid out on paper: on one sheet where it has room, else on two, of which the first
// has the 3D view and the second begins with the plots.
import type { RunData } from "./data";

export const needsTwoSheets = (runs: RunData[]) =>
  runs.length > 1 || runs.some((run) => run.cameras.length > 1);

/** Of the 3D view, in pixels of the sheet (report.css); two runs lie one above the other. */
export function stageHeight_px(shown: number, isTwoSheets: boolean): number {
  if (!isTwoSheets) return 230;
  return shown === 1 ? 480 : shown === 2 ? 480 : 300;
}

/** Of a plot that is 350 px wide. */
export const plotHeight_px = (isTwoSheets: boolean) => (isTwoSheets ? 190 : 94);
