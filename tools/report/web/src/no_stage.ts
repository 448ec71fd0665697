// What stands in the place of the 3D view.
import type { View3d } from "./controls";
import { make } from "./dom";

/** In the place of the view, where the browser cannot draw it. */
export class NoStage implements View3d {
  readonly canDraw = false;
  readonly element = make("div", { class: "stage none" }, make("p", { class: "nothing" },
    "3D needs WebGL, which this browser or its settings do not offer."));
  setShown() {}
  setLayers() {}
  colour() {}
  setFollows() {}
  setTheme() {}
  drawNow() {}
  frame() {}
  buttons() { return []; }
  cameraState() { return []; }
  setCamera() {}
  lookAt() {}
  onChange() {}
  cameraPosition() { return []; }
  pictures() { return { whole: 0, gist: 0 }; }
}
