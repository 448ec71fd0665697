// Draws the panes of the 3D view.
import * as three from "three";
import type { Clock } from "./clock";
import { DepthShading } from "./depth_shading";
import type { RunScene, Side } from "./run_scene";

export interface Pane {
  x: number;
  y: number; // from below
  width: number;
  height: number;
}

export class Painter {
  private readonly renderer: three.WebGLRenderer;
  private readonly shading = new DepthShading();

  /** Throws where there is no WebGL. */
  constructor(canvas: HTMLCanvasElement) {
    this.renderer = new three.WebGLRenderer({ canvas, antialias: true });
    this.renderer.setScissorTest(true);
    this.renderer.autoClear = false;
    this.renderer.debug.checkShaderErrors = false; // asking waits for the compiler
  }

  get background() { return this.shading.background; }

  fitCanvas(width: number, height: number, ratio: number) {
    const size = this.renderer.getSize(new three.Vector2());
    if (size.x === width && size.y === height && this.renderer.getPixelRatio() === ratio) return;
    this.renderer.setDrawingBufferSize(width, height, ratio); // once: it takes its time
  }

  /**
   * A scene at the clock's time into its pane, whole or the gist of it; `share` of it is the truth
   * where a surface is beside it.
   */
  paint(scene: RunScene, clock: Clock, camera: three.PerspectiveCamera, pane: Pane,
      pxPerTan: number, isWhole: boolean, share: number) {
    const { x, y, width, height } = pane;
    this.renderer.setViewport(x, y, width, height);
    const render = (side: Side, from: number, to: number) => {
      scene.showSide(side);
      scene.show(clock, camera, pxPerTan, isWhole);
      this.renderer.setScissor(x + from, y, to - from, height);
      this.shading.render(this.renderer, scene.scene, camera, width, height, isWhole,
        scene.relief_m());
    };
    if (scene.isSwiped()) {
      const line = Math.round(width * share);
      render("truth", 0, line);
      render("surface", line, width);
      scene.showSide("all");
    } else {
      render("all", 0, width);
    }
  }

  /** Until it is drawn: what was asked for so far is only in a queue. */
  wait() {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }
}
