// The 3D view: a pane for each run that is shown, and one camera for all of them.
import * as three from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { Axes } from "./axes";
import { isDark } from "./colours";
import type { Clock } from "./clock";
import { make, ofRun } from "./dom";
import { Detail } from "./detail";
import { Painter } from "./painter";
import { PaneCamera, nearestThatSees } from "./pane_camera";
import { needsTwoSheets, stageHeight_px } from "./paper";
import { kAim_px, kPointer_px, listenToClicks, moveByKey, pick } from "./pick";
import { Pointing } from "./pointing";
import { kGistRatio, type Layers, type RunScene } from "./run_scene";
import { saveFile } from "./save";
import { Swipe } from "./swipe";
import type { Colouring } from "./surfaces";

const kLeastPane_px = 400; // narrower ones stand one above the other
const kAround = 0.35; // of the structure's extent, how far a camera stands from a part at least

export class Stage {
  readonly element: HTMLElement;
  private readonly canvas = make("canvas", { tabindex: 0, role: "img", "aria-label":
    "3D view of the mission. Drag or a, d, w, s to turn, wheel or + and - to zoom, right drag or "
    + "j, l, i, k to move, 0 to fit, a click or Enter in the middle tells what is there, "
    + "arrow keys replay." });
  private readonly labels = make("div", { class: "panes" });
  private readonly painter: Painter;
  private readonly camera = new three.PerspectiveCamera(38, 1, 0.1, 1000);
  private readonly paneCameras = new Map<RunScene, PaneCamera>();
  private readonly controls: OrbitControls;
  private shown: RunScene[];
  private isStale = false;
  private size = ""; // drawn last
  private readonly detail = new Detail(() => this.request());
  private isFramed = false;
  private isPrinted = false;
  private readonly pointing: Pointing;
  private axes: Axes[] = []; // of each pane
  private readonly swipe = new Swipe(() => this.invalidate());

  constructor(private readonly scenes: RunScene[], private readonly clock: Clock,
      private readonly name: string, goTo: (view: number) => void) {
    this.shown = scenes;
    this.pointing = new Pointing(goTo);
    this.element = make("div", { class: "stage" }, this.canvas, this.labels,
      this.pointing.element, make("span", { class: "aim" }), this.swipe.element);
    for (const scene of scenes) {
      scene.onLoad = () => this.invalidate();
      this.paneCameras.set(scene, new PaneCamera(scenes[0], scene));
    }
    this.painter = new Painter(this.canvas);
    this.camera.up.set(0, 0, 1);
    this.controls = new OrbitControls(this.camera, this.canvas);
    this.controls.maxPolarAngle = 0.55 * Math.PI;
    this.controls.addEventListener("change", () => this.invalidate());
    this.canvas.addEventListener("dblclick", () => this.frame());
    listenToClicks(this.canvas, (x, y) => this.pickAt(x, y, kPointer_px));
    this.canvas.addEventListener("keydown", (event) => this.handleKey(event));
    new ResizeObserver(() => { if (this.sizeNow() !== this.size) this.resize(); })
      .observe(this.element);
    addEventListener("beforeprint", () => this.print(true));
    addEventListener("afterprint", () => this.print(false));
    clock.onChange(() => this.invalidate());
    this.setTheme();
    this.setShown(scenes);
  }

  invalidate() {
    this.detail.change();
    this.request();
  }

  /** Before the browser would ask for it: who prints at once asks for none. */
  drawNow() {
    this.resize();
    this.draw();
  }

  /** For paper in its own shape, a whole picture; and back. */
  private print(isPrinted: boolean) {
    this.isPrinted = isPrinted;
    this.element.classList.toggle("printed", isPrinted);
    this.element.style.setProperty("--paper", `${stageHeight_px(this.shown.length,
      needsTwoSheets(this.scenes.map(({ flight }) => flight.data)))}px`);
    this.resize();
    if (!isPrinted || !this.isStale) return; // or it has been drawn in its new size
    this.detail.insist();
    this.draw();
  }

  private request() {
    if (this.isStale) return;
    this.isStale = true;
    requestAnimationFrame(() => { if (this.isStale) this.draw(); });
  }

  setShown(scenes: RunScene[]) {
    this.shown = scenes;
    for (const scene of scenes) scene.compareWith(scenes.filter((other) => other !== scene));
    this.axes = scenes.map(() => new Axes());
    this.labels.replaceChildren(...scenes.map((scene, i) => make("div", { class: "pane" },
      this.scenes.length > 1
        ? ofRun("chip", scene.flight.index, scene.flight.data.label)
        : null, this.axes[i].element)));
    this.resize();
  }

  setLayers(layers: Layers) {
    for (const scene of this.scenes) scene.setLayers(layers);
    this.swipe.show(this.scenes.some((scene) => scene.isSwiped()));
    this.invalidate();
  }

  colour(by: Colouring) {
    for (const scene of this.scenes) scene.colour(by);
    this.invalidate();
  }

  buttons() {
    const button = (text: string, title: string, click: () => void) =>
      make("button", { type: "button", class: "small", title, click }, text);
    return [this.pointing.button,
      button("Save PNG", "The 3D view as a picture file", () => this.save()),
      button("Full screen", "Escape leaves it", () => {
        if (document.fullscreenElement) void document.exitFullscreen();
        else void this.element.closest(".view")?.requestFullscreen();
      })];
  }

  onChange(listener: () => void) { this.controls.addEventListener("change", listener); }

  cameraState() { return [...this.camera.position.toArray(), ...this.controls.target.toArray()]; }

  setCamera(state: number[]) {
    this.frame(); // for the depths
    this.camera.position.fromArray(state, 0);
    this.controls.target.fromArray(state, 3);
    this.controls.update();
  }

  /** At a place of the scene's and what stands around it, from `back` of it. */
  lookAt(scene: RunScene, centre: three.Vector3, back: three.Vector3, radius_m: number) {
    const pane = this.pane(scene);
    const extent_m = scene.bounds().getSize(new three.Vector3()).length();
    const target = pane.inFirst(centre);
    this.camera.position.copy(target)
      .addScaledVector(back, pane.scale * Math.max(3.2 * radius_m, kAround * extent_m));
    this.controls.target.copy(target);
    this.controls.update();
    this.invalidate();
  }

  /** A whole picture, whatever it takes. */
  private save() {
    this.detail.insist();
    this.draw(); // in this very task, or the browser would have cleared the canvas
    this.canvas.toBlob((blob) => saveFile(blob, `${this.name}.png`));
  }

  private handleKey(event: KeyboardEvent) {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (event.key === "Enter") {
      const { clientWidth, clientHeight } = this.canvas;
      this.pickAt(clientWidth / 2, clientHeight / 2, kAim_px);
    } else if (event.key === "0") {
      this.frame();
    } else if (moveByKey(event.key, this.camera, this.controls.target)) {
      this.controls.update();
      this.invalidate();
    }
  }

  private pickAt(x: number, y: number, near_px: number) {
    const { width, height } = this.paneSize();
    const pane = Math.floor(this.isColumn() ? y / height : x / width);
    const scene = this.shown[pane];
    if (!scene) return;
    const [left, top] = this.isColumn() ? [0, pane * height] : [pane * width, 0];
    this.pointing.tell(
      pick(scene, this.cameraOf(scene), x - left, y - top, width, height, near_px), scene);
  }

  setTheme() {
    this.painter.background.setHex(isDark() ? 0x14181e : 0xf4f6f9);
    this.invalidate();
  }

  cameraPosition() { return this.camera.position.toArray(); }
  pictures() { return this.detail.drawnSoFar; }

  /** Puts the camera where it sees all that is shown. */
  frame() {
    const outlines = this.shown.map((scene) => this.pane(scene).allInFirst(scene.outline()));
    const box = new three.Box3();
    for (const outline of outlines) box.union(new three.Box3().setFromArray(outline));
    const centre = box.getCenter(new three.Vector3());
    const { width, height } = this.paneSize();
    const back = new three.Vector3(0.55, -0.8, 0.5).normalize();
    const away = nearestThatSees(outlines, centre, back, this.camera.fov, height / width);
    this.isFramed = true;
    this.setDepths(away);
    this.camera.position.copy(centre).addScaledVector(back, away);
    this.controls.target.copy(centre);
    this.controls.update();
    this.invalidate();
  }

  /** So that nothing is cut off, as far as anybody may go from a picture taken at `away`. */
  private setDepths(away: number) {
    const extent = this.scenes[0]?.bounds().getSize(new three.Vector3()).length() ?? 1;
    this.controls.maxDistance = 4 * Math.max(away, extent);
    this.camera.far = this.controls.maxDistance + 2 * extent;
    this.camera.near = this.camera.far / 2500;
    this.camera.updateProjectionMatrix();
  }

  private pane(scene: RunScene) { return this.paneCameras.get(scene)!; }

  private cameraOf(scene: RunScene) { return this.pane(scene).of(this.camera); }

  private isColumn() {
    if (this.isPrinted) return this.shown.length === 2;
    return this.element.clientWidth < kLeastPane_px * this.shown.length;
  }

  private sizeNow() { return `${this.element.clientWidth}x${this.element.clientHeight}`; }

  private paneSize() {
    const count = Math.max(1, this.shown.length);
    const { clientWidth: w, clientHeight: h } = this.element;
    return this.isColumn() ? { width: w, height: h / count } : { width: w / count, height: h };
  }

  private resize() {
    const { clientWidth, clientHeight } = this.element;
    if (clientWidth === 0 || clientHeight === 0) return;
    this.labels.classList.toggle("column", this.isColumn());
    this.detail.change();
    const { width, height } = this.paneSize();
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (!this.isFramed) this.frame();
    const size = this.sizeNow();
    const isResized = this.size !== "" && this.size !== size;
    this.size = size;
    if (!isResized) { this.request(); return; }
    this.isStale = true;
    // paper does not wait for the whole one
    if (this.isPrinted || matchMedia("print").matches) this.detail.insist();
    this.draw(); // now, or a resized canvas would show one empty picture
  }

  private draw() {
    this.isStale = false;
    const { isWhole } = this.detail;
    const { width, height } = this.paneSize();
    const { clientWidth, clientHeight: total } = this.element;
    if (clientWidth === 0 || total === 0) return;
    const begin = performance.now();
    const ratio = (this.isPrinted ? 2 : Math.min(2, devicePixelRatio)) * (isWhole ? 1 : kGistRatio);
    this.painter.fitCanvas(clientWidth, total, ratio);
    const pxPerTan = 0.5 * height * ratio /
      Math.tan(three.MathUtils.degToRad(this.camera.fov) / 2);
    for (const axes of this.axes) axes.show(this.camera);
    this.shown.forEach((scene, i) => {
      const [x, y] = this.isColumn() ? [0, total - (i + 1) * height] : [i * width, 0];
      this.painter.paint(scene, this.clock, this.cameraOf(scene), { x, y, width, height }, pxPerTan,
        isWhole, this.swipe.share);
    });
    if (isWhole) this.painter.wait();
    this.detail.drawn(performance.now() - begin);
  }
}
