// The flown path with few corners: a hundred samples of a straight way look like two.
import type { Flight } from "./flight";

const kOff_m = 0.03; // no sample lies farther from the line that stands for it

/** Squared distance of sample `i` to the line from sample `a` to sample `b`. */
function offSquared(points: Float32Array, i: number, a: number, b: number): number {
  const d = [0, 1, 2].map((k) => points[3 * b + k] - points[3 * a + k]);
  const p = [0, 1, 2].map((k) => points[3 * i + k] - points[3 * a + k]);
  const length = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
  const t = length > 0
    ? Math.min(1, Math.max(0, (p[0] * d[0] + p[1] * d[1] + p[2] * d[2]) / length)) : 0;
  return (p[0] - t * d[0]) ** 2 + (p[1] - t * d[1]) ** 2 + (p[2] - t * d[2]) ** 2;
}

/** Indices of the samples that stand for those in [begin, end): Douglas and Peucker 1973. */
export function corners(points: Float32Array, begin: number, end: number): number[] {
  if (end - begin < 2) return end > begin ? [begin] : [];
  const kept = [begin];
  const open: [number, number][] = [[begin, end - 1]];
  while (open.length > 0) {
    const [a, b] = open.pop()!;
    let worst = a;
    let off = kOff_m * kOff_m;
    for (let i = a + 1; i < b; ++i) {
      const away = offSquared(points, i, a, b);
      if (away > off) [worst, off] = [i, away];
    }
    if (worst === a) kept.push(b); else open.push([worst, b], [a, worst]);
  }
  return kept;
}

/** The same, with a corner at the last sample of each view, where the replay rests. */
export function cornersOfViews(flight: Flight, begin: number, end: number): number[] {
  const stops = Array.from(flight.data.views.time, (time) => flight.samplesBy(time) - 1)
    .filter((sample) => sample > begin && sample < end - 1);
  const all: number[] = [];
  let from = begin;
  for (const stop of [...stops, end - 1]) {
    if (stop <= from) continue;
    all.push(...corners(flight.points!, from, stop + 1).slice(all.length > 0 ? 1 : 0));
    from = stop;
  }
  return all;
}
