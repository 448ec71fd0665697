// Draws the panes of the 3D view, with whatever this machine draws points best.
import * as three from "three";
import type { Clock } from "./clock";
import { DepthShading, kPointLayer, kSplatLayer } from "./depth_shading";
import type { RunScene } from "./run_scene";

const kProbePoints = 20_000;
const kProbe_ms = 25; // a renderer that takes longer for them draws no points

export interface Pane {
  x: number;
  y: number; // from below
  width: number;
  height: number;
}

export class Painter {
  private readonly renderer: three.WebGLRenderer;
  private readonly shading = new DepthShading();
  private drawsPoints: boolean | null = null; // the renderer; unknown before the first whole picture
  private now: { clock: Clock; camera: three.PerspectiveCamera; pxPerTan: number; isWhole: boolean;
    splats: boolean } | null = null;

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

  /** Before the panes of a picture, whole or the gist of it. */
  begin(shown: RunScene[], clock: Clock, camera: three.PerspectiveCamera, pxPerTan: number,
      isWhole: boolean) {
    this.now = { clock, camera, pxPerTan, isWhole, splats: true };
    if (isWhole && this.drawsPoints === null) this.drawsPoints = this.probe(shown);
    this.now.splats = !isWhole || this.drawsPoints === false;
  }

  /** A scene into its pane; `share` of it is the truth where a surface is beside it. */
  paint(scene: RunScene, camera: three.PerspectiveCamera, pane: Pane, share: number) {
    const { clock, pxPerTan, isWhole, splats } = this.now!;
    const { x, y, width, height } = pane;
    scene.show(clock, camera, pxPerTan, isWhole, splats);
    this.renderer.setViewport(x, y, width, height);
    const render = (from: number, to: number) => {
      this.renderer.setScissor(x + from, y, to - from, height);
      this.shading.render(this.renderer, scene.scene, camera, width, height, isWhole,
        splats ? kSplatLayer : kPointLayer, scene.relief_m());
    };
    if (!scene.isSwiped()) { render(0, width); return; }
    const line = Math.round(width * share);
    scene.showSide("truth");
    scene.show(clock, camera, pxPerTan, isWhole, splats);
    render(0, line);
    scene.showSide("surface");
    scene.show(clock, camera, pxPerTan, isWhole, splats);
    render(line, width);
    scene.showSide("all");
  }

  /** Until it is drawn: what was asked for so far is only in a queue. */
  wait() {
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
  }

  /** Whether the renderer draws points as fast as a graphics card; null where there are none. */
  private probe(shown: RunScene[]): boolean | null {
    const scene = shown.find((each) => each.model.cloud?.visible);
    if (!scene) return null;
    const { clock, camera, pxPerTan } = this.now!;
    let took_ms = 0;
    scene.show(clock, camera, pxPerTan, false, false);
    for (const points of [1, kProbePoints]) { // the first one makes it compile
      scene.model.limit(points);
      const begin = performance.now();
      this.shading.render(this.renderer, scene.scene, camera, 64, 64, true, kPointLayer);
      this.wait();
      took_ms = performance.now() - begin;
    }
    return took_ms <= kProbe_ms;
  }
}
