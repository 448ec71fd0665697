// Pictures of the page as files: the 3D view as PNG, a plot as PNG or SVG.
import { make } from "./dom";

function download(url: string, name: string) {
  const link = make("a", { href: url, download: name });
  link.click();
}

export function savePng(canvas: HTMLCanvasElement, name: string) {
  canvas.toBlob((blob) => {
    if (!blob) return;
    const url = URL.createObjectURL(blob);
    download(url, `${name}.png`);
    setTimeout(() => URL.revokeObjectURL(url), 10_000);
  });
}

export function saveText(text: string, type: string, name: string) {
  const url = URL.createObjectURL(new Blob([text], { type }));
  download(url, name);
  setTimeout(() => URL.revokeObjectURL(url), 10_000);
}

/** For file names: "a_b" of "A: b". */
export const fileName = (title: string) =>
  title.toLowerCase().replace(/[^a-z0-9]+/g, "_").replace(/^_|_$/g, "") || "gnbv";
