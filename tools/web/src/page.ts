// Reads what the program wrote into the page: JSON beside a block of bytes, in which the arrays lie
// that the JSON names (tools/page/arrays.hpp).
import type { PageData } from "./data";

const kTypes = { uint8: Uint8Array, int16: Int16Array, uint16: Uint16Array, uint32: Uint32Array,
  float32: Float32Array, float64: Float64Array };

interface NamedArray {
  array: keyof typeof kTypes | "points" | "numbers";
  at: number;
  shape: [number, number];
  min: number[]; // of points
  size: number[];
}

function arrayOf(bytes: Uint8Array<ArrayBuffer>, { array, at, shape, min, size }: NamedArray) {
  const count = shape[0] * shape[1];
  if (array === "points") {
    const steps = new Uint16Array(bytes.buffer, at, count);
    const points = new Float32Array(count);
    for (let i = 0; i < count; ++i) points[i] = min[i % 3] + size[i % 3] * steps[i] / 65535;
    return points;
  }
  if (array !== "numbers") return new kTypes[array](bytes.buffer, at, count);
  const numbers = new Uint32Array(count);
  for (let i = 0, scale = 1, byte = at; i < count; ++byte) {
    numbers[i] += (bytes[byte] & 127) * scale;
    scale *= 128;
    if (bytes[byte] < 128) [i, scale] = [i + 1, 1];
  }
  return numbers;
}

export function readPage(): PageData {
  const text = atob(document.getElementById("arrays")!.textContent!);
  const bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
  return JSON.parse(document.getElementById("data")!.textContent!, (_, value) =>
    (value?.array ? arrayOf(bytes, value) : value)) as PageData;
}
