// Buttons of the 3D view that need nothing of it but its picture and its place.
import { make } from "./dom";

export function stageButtons(stage: HTMLElement, save: () => void): HTMLElement[] {
  const button = (text: string, title: string, click: () => void) =>
    make("button", { type: "button", class: "small", title, click }, text);
  return [button("Save PNG", "The 3D view as a picture file", save),
    button("Full screen", "Escape leaves it", () => {
      if (document.fullscreenElement) void document.exitFullscreen();
      else void stage.closest(".view")?.requestFullscreen();
    })];
}
