// Pictures of the page as files: the 3D view as PNG, a plot as SVG.
import { make } from "./dom";

export function saveFile(blob: Blob | null, name: string) {
  if (!blob) return;
  const url = URL.createObjectURL(blob);
  make("a", { href: url, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** For file names: "a_b" of "A: b". */
export const fileName = (title: string) =>
  title.toLowerCase().replace(/[^a-z0-9]+/g, "_").replace(/^_|_$/g, "") || "gnbv";
