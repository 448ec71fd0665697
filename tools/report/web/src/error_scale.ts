// What the colours of errors stand for: errors of one run may be millimetres, of another ten times that.

export interface ErrorScale {
  most_mm: number; // of the scale: 1, 2 or 5 times a power of ten
  median_mm: number;
}

const kNotOfStructure = 255; // in the packed errors, in millimetres
const kWithin = 0.95; // of the points lie within the scale, at least

/** Of a run's errors as the page has them; null where no point is one of the structure. */
export function errorScale(errors: Uint8Array): ErrorScale | null {
  const known = errors.filter((error) => error !== kNotOfStructure).sort();
  if (known.length === 0) return null;
  const within = Math.max(1, known[Math.ceil(kWithin * known.length) - 1]);
  const decade = 10 ** Math.floor(Math.log10(within));
  const most_mm = decade * ([1, 2, 5, 10].find((k) => k * decade >= within) ?? 10);
  return { most_mm, median_mm: known[Math.floor((known.length - 1) / 2)] };
}
