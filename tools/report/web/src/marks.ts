// Lines and dots of the mission: flown path, views, camera pyramids.
import * as three from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { isDark, planColour as planHex, ramp } from "./colours";
import type { CameraData } from "./data";
import { lastAtMost, type Flight } from "./flight";
import { cornersOfViews } from "./path_line";

const srgb = (c: [number, number, number]) =>
  new three.Color().setRGB(c[0] / 255, c[1] / 255, c[2] / 255, three.SRGBColorSpace);

const planColour = () => new three.Color(planHex());

/** The colour of the view that is `t` of the way from the first to the last. */
export const orderColour = (t: number) => srgb(ramp("path", t));

/** Lines of that width; six numbers a segment, of places and of colours. */
export function makeTube(positions: Float32Array, colours: Float32Array, width_px: number,
    opacity: number) {
  const geometry = new LineSegmentsGeometry();
  if (positions.length > 0) geometry.setPositions(positions).setColors(colours);
  const tube = new LineSegments2(geometry, new LineMaterial({ linewidth: width_px,
    vertexColors: true, transparent: opacity < 1, opacity }));
  tube.frustumCulled = false;
  return tube;
}

/** Likewise, as thin as the renderer has them, which is quicker. */
function makeLines(positions: Float32Array, colours: Float32Array, opacity: number) {
  const geometry = new three.BufferGeometry();
  geometry.setAttribute("position", new three.BufferAttribute(positions, 3));
  geometry.setAttribute("color", new three.BufferAttribute(colours, 3));
  const lines = new three.LineSegments(geometry, new three.LineBasicMaterial({
    vertexColors: true, transparent: opacity < 1, opacity }));
  lines.frustumCulled = false;
  return lines;
}

/** A piece of the path: the samples that are its corners, and the line through them. */
interface Piece {
  corners: number[];
  line: LineSegments2;
  thin: three.LineSegments; // the same for the gist
}

/**
 * The flown path, the profile's part of it thin and grey; show(n) leaves the first n samples, as
 * far as their last corner, and a straight end from there.
 */
export class PathMark {
  readonly object = new three.Group();
  private readonly profile: Piece;
  private readonly planned: Piece;
  private readonly end = makeTube(new Float32Array(6), new Float32Array(6), 2.4, 1);
  private layers = [true, true];

  constructor(private readonly flight: Flight) {
    const points = flight.points ?? new Float32Array();
    const count = points.length / 3;
    const firstView = Math.min(flight.firstViewSample(), count);
    const grey = new three.Color(isDark() ? 0x75808e : 0x8a95a3);
    const piece = (begin: number, end: number, width_px: number, opacity: number,
        colourOf: (share: number) => three.Color): Piece => {
      const corners = cornersOfViews(flight, begin, end);
      const segments = Math.max(0, corners.length - 1);
      const positions = new Float32Array(6 * segments);
      const colours = new Float32Array(6 * segments);
      for (let i = 0; i < segments; ++i) {
        const colour = colourOf((corners[i] - begin) / (end - begin));
        for (const [j, at] of [[i, 6 * i], [i + 1, 6 * i + 3]]) {
          positions.set(points.subarray(3 * corners[j], 3 * corners[j] + 3), at);
          colour.toArray(colours, at);
        }
      }
      return { corners, line: makeTube(positions, colours, width_px, opacity),
        thin: makeLines(positions, colours, opacity) };
    };
    this.profile = piece(0, firstView, 1.2, 0.7, () => grey);
    this.planned = piece(Math.max(0, firstView - 1), count, 2.4, 1, orderColour);
    for (const { line, thin } of [this.profile, this.planned]) this.object.add(line, thin);
    this.object.add(this.end);
  }

  setLayers(showsPlanned: boolean, showsProfile: boolean) {
    this.layers = [showsPlanned, showsProfile];
  }

  show(samples: number, isWhole: boolean) {
    this.end.visible = false;
    this.showPiece(this.profile, samples, isWhole, this.layers[1], 0.7);
    this.showPiece(this.planned, samples, isWhole, this.layers[0], 1);
  }

  private showPiece({ corners, line, thin }: Piece, samples: number, isWhole: boolean,
      isShown: boolean, opacity: number) {
    const last = lastAtMost(corners, samples - 1);
    line.geometry.instanceCount = Math.max(0, last);
    thin.geometry.setDrawRange(0, Math.max(0, 2 * last));
    line.visible = isShown && isWhole && last > 0;
    thin.visible = isShown && !isWhole && last > 0;
    if (!isShown || last < 0 || last + 1 >= corners.length) return;
    if (samples - 1 <= corners[last]) return;
    const points = this.flight.points!;
    const ends = [corners[last], samples - 1].flatMap((i) => [...points.slice(3 * i, 3 * i + 3)]);
    const colours = line.geometry.getAttribute("instanceColorStart") as
      three.InterleavedBufferAttribute;
    const at = Math.min(last, colours.count - 1);
    const colour = [colours.getX(at), colours.getY(at), colours.getZ(at)];
    this.end.geometry.setPositions(ends).setColors([...colour, ...colour]);
    this.end.material.linewidth = line.material.linewidth;
    this.end.material.opacity = opacity;
    this.end.visible = true;
  }
}

/** Corners of a camera's picture, `depth` metres in front of it, in the body. */
function pictureCorners(camera: CameraData, depth: number): three.Vector3[] {
  const T = new three.Matrix4().fromArray(camera.T_body_camera);
  const [x, y] = [depth * Math.tan(camera.fov_x / 2), depth * Math.tan(camera.fov_y / 2)];
  return [[-x, -y], [x, -y], [x, y], [-x, y]].map(([u, v]) =>
    new three.Vector3(u, v, depth).applyMatrix4(T));
}

function pyramidEdges(camera: CameraData, depth: number): three.Vector3[] {
  const corners = pictureCorners(camera, depth);
  const apex = new three.Vector3().setFromMatrixPosition(
    new three.Matrix4().fromArray(camera.T_body_camera));
  return corners.flatMap((corner, i) => [apex, corner, corner, corners[(i + 1) % 4]]);
}

/** Small pyramids of every view; show(n) leaves the first n. */
export class FrustaMark {
  readonly object: three.LineSegments;
  private readonly perView: number;

  constructor(flight: Flight) {
    const edgesAt = (view: number) =>
      flight.camerasAt(view).flatMap((camera) => pyramidEdges(camera, 0.9));
    this.perView = edgesAt(0).length;
    const positions = new Float32Array(3 * this.perView * flight.count);
    const colours = new Float32Array(positions.length);
    for (let view = 0; view < flight.count; ++view) {
      const { p, q } = flight.viewPose(view);
      const colour = orderColour(view / Math.max(1, flight.count - 1));
      edgesAt(view).forEach((edge, i) => {
        const at = 3 * (view * this.perView + i);
        edge.clone().applyQuaternion(q).add(p).toArray(positions, at); // edges share corners
        colour.toArray(colours, at);
      });
    }
    const geometry = new three.BufferGeometry();
    geometry.setAttribute("position", new three.BufferAttribute(positions, 3));
    geometry.setAttribute("color", new three.BufferAttribute(colours, 3));
    this.object = new three.LineSegments(geometry,
      new three.LineBasicMaterial({ vertexColors: true, transparent: true, opacity: 0.8 }));
    this.object.frustumCulled = false;
  }

  show(views: number) { this.object.geometry.setDrawRange(0, views * this.perView); }

  /** Ends of the lines of a view, x y z each. */
  lines(view: number): number[] {
    const { array } = this.object.geometry.getAttribute("position");
    return [...array.slice(3 * view * this.perView, 3 * (view + 1) * this.perView)];
  }
}

/** What a tour still means to do: the line through its views, and what the next ones look at. */
export class PlanMark {
  readonly object = new three.Group();
  count = 0; // of views drawn
  private readonly poses: Float32Array; // place of the body and quaternion of the camera, a view
  private readonly ranges: Uint32Array; // begin and end, a view that was taken
  private shownAfter = -1; // view
  private static readonly kSoon = 5; // views whose line and pyramids stand out
  private static readonly kPoseNumbers = 7;

  constructor(private readonly flight: Flight) {
    const plan = flight.data.plan!;
    this.poses = flight.bytes.f32(plan.poses);
    this.ranges = flight.bytes.u32(plan.ranges);
  }

  /** After the first `views` views. */
  show(views: number) {
    if (views === this.shownAfter) return;
    this.shownAfter = views;
    for (const part of this.object.children) (part as three.Mesh).geometry.dispose();
    this.object.clear();
    const [begin, end] = views > 0 ? this.ranges.subarray(2 * views - 2, 2 * views) : [0, 0];
    this.count = end - begin;
    if (this.count === 0) return;
    const soonEnd = Math.min(begin + PlanMark.kSoon, end);
    const here = this.flight.viewPose(views - 1).p;
    this.object.add(this.line(here, begin, soonEnd, 2.6, 1), this.pyramids(begin, soonEnd));
    if (soonEnd < end) {
      this.object.add(this.line(this.place(soonEnd - 1), soonEnd, end, 1.3, 0.6),
        this.dots(soonEnd, end));
    }
    this.object.traverse((part) => part.layers.mask = this.object.layers.mask);
  }

  /** Places (x y z each) of the views that are drawn. */
  drawn(): number[] {
    if (this.count === 0) return [];
    const [begin, end] = this.ranges.subarray(2 * this.shownAfter - 2, 2 * this.shownAfter);
    return Array.from({ length: end - begin }, (_, i) => this.place(begin + i).toArray()).flat();
  }

  private place(pose: number) {
    return new three.Vector3().fromArray(this.poses, PlanMark.kPoseNumbers * pose);
  }

  private line(from: three.Vector3, begin: number, end: number, width_px: number,
      opacity: number) {
    const positions = new Float32Array(6 * (end - begin));
    const colours = new Float32Array(positions.length);
    for (let i = begin; i < end; ++i) {
      (i === begin ? from : this.place(i - 1)).toArray(positions, 6 * (i - begin));
      this.place(i).toArray(positions, 6 * (i - begin) + 3);
    }
    for (let i = 0; i < colours.length; i += 3) planColour().toArray(colours, i);
    return makeTube(positions, colours, width_px, opacity);
  }

  private dots(begin: number, end: number) {
    const places = Array.from({ length: end - begin }, (_, i) => this.place(begin + i));
    return new three.Points(new three.BufferGeometry().setFromPoints(places),
      new three.PointsMaterial({ color: planColour(), size: 5, sizeAttenuation: false }));
  }

  private pyramids(begin: number, end: number) {
    const { min, max } = this.flight.data.workspace;
    const depth = 0.035 * new three.Vector3(...min).distanceTo(new three.Vector3(...max));
    const camera = { ...this.flight.data.cameras[0], T_body_camera: new three.Matrix4().toArray() };
    const edges = pyramidEdges(camera, depth);
    const points: three.Vector3[] = [];
    for (let i = begin; i < end; ++i) {
      const q = new three.Quaternion().fromArray(this.poses, PlanMark.kPoseNumbers * i + 3);
      for (const edge of edges) points.push(edge.clone().applyQuaternion(q).add(this.place(i)));
    }
    const lines = new three.LineSegments(new three.BufferGeometry().setFromPoints(points),
      new three.LineBasicMaterial({ color: planColour() }));
    lines.frustumCulled = false;
    return lines;
  }
}

/** What the cameras of the vehicle see now, out to their range or to `most_m`; to be put on the
 * vehicle's pose. */
export function makeSight(cameras: CameraData[], most_m: number): three.Group {
  const group = new three.Group();
  const faces = new three.MeshBasicMaterial({ color: 0xff8a3c, transparent: true, opacity: 0.07,
    depthWrite: false, side: three.DoubleSide });
  const lines = new three.LineBasicMaterial({ color: 0xff8a3c, transparent: true, opacity: 0.75 });
  for (const camera of cameras) {
    const depth = Math.min(camera.range_m, most_m);
    const edges = pyramidEdges(camera, depth);
    group.add(new three.LineSegments(new three.BufferGeometry().setFromPoints(edges), lines));
    const corners = pictureCorners(camera, depth);
    const sides = corners.flatMap((corner, i) => [edges[0], corner, corners[(i + 1) % 4]]);
    group.add(new three.Mesh(new three.BufferGeometry().setFromPoints(sides), faces));
  }
  return group;
}
