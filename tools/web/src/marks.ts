// Lines and dots of the mission: flown path, views, what is planned, camera pyramids.
import * as three from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { colourOf, ramp } from "./colours";
import type { CameraData } from "./data";
import type { Flight } from "./flight";

type Numbers = ArrayLike<number>;

export const numbersOf = (points: three.Vector3[]) => points.flatMap((point) => point.toArray());

/** Of one colour, as many numbers as there are places; else as they are. */
function coloursOf(places: Numbers, colours: Numbers | number): Numbers {
  if (typeof colours !== "number") return colours;
  const rgb = new three.Color(colours).toArray();
  return Array.from({ length: places.length }, (_, i) => rgb[i % 3]);
}

/** Of places, x y z each, of one colour or r g b each. */
function geometryOf(places: Numbers, colours: Numbers | number): three.BufferGeometry {
  return new three.BufferGeometry()
    .setAttribute("position", new three.Float32BufferAttribute(places, 3))
    .setAttribute("color", new three.Float32BufferAttribute(coloursOf(places, colours), 3));
}

/** Lines of that width; three numbers an end. */
export function makeTube(places: Numbers, colours: Numbers | number, width_px: number,
    opacity = 1) {
  const geometry = new LineSegmentsGeometry().setPositions(Float32Array.from(places))
    .setColors(Float32Array.from(coloursOf(places, colours)));
  return new LineSegments2(geometry, new LineMaterial({ linewidth: width_px, vertexColors: true,
    transparent: opacity < 1, opacity }));
}

/** Thin ones. */
export const makeLines = (places: Numbers, colours: Numbers | number, opacity = 1) =>
  // all with colours of their own and blended: of one kind, whose shader is compiled once
  new three.LineSegments(geometryOf(places, colours), new three.LineBasicMaterial(
    { vertexColors: true, transparent: true, opacity, depthWrite: opacity > 0.5 }));

/** Dots of that size. */
export const makeDots = (places: Numbers, colours: Numbers | number, size: number) =>
  new three.Points(geometryOf(places, colours),
    new three.PointsMaterial({ vertexColors: true, size, sizeAttenuation: false }));

/** What is drawn anew for each view, where it is shown. */
export abstract class ViewMark {
  readonly object = new three.Group();
  private drawnFor = "";

  /** After the first `n` views. */
  show(n: number) {
    const state = `${n} ${this.variant()}`;
    if (state === this.drawnFor || !this.object.visible) return;
    this.drawnFor = state;
    for (const part of this.object.children) (part as three.Mesh).geometry.dispose();
    this.object.clear();
    for (const part of this.parts(n)) {
      part.layers.mask = this.object.layers.mask;
      part.frustumCulled = false;
      this.object.add(part);
    }
  }

  protected abstract parts(n: number): three.Object3D[];

  /** What else it depends on. */
  protected variant(): string { return ""; }
}

/** The flown path, the profile's part of it thin and grey; show() leaves its first samples. */
export class PathMark {
  readonly object = new three.Group();
  private readonly lines: LineSegments2[]; // of the profile, of the views
  private readonly ofProfile: number; // samples

  constructor(flight: Flight) {
    const { points } = flight;
    const count = (points?.length ?? 0) / 3;
    this.ofProfile = Math.max(1, flight.profileSamples());
    const grey = new three.Color(colourOf("profile"));
    const line = (begin: number, end: number, width_px: number, opacity: number,
        colourAt: (share: number) => three.Color) => {
      const samples = Array.from({ length: Math.max(0, end - begin) }, (_, i) => begin + i);
      return makeTube(samples.flatMap((i) => [...points!.subarray(3 * i - 3, 3 * i + 3)]),
        samples.flatMap((i) => {
          const rgb = colourAt((i - begin) / (end - begin)).toArray();
          return [...rgb, ...rgb];
        }), width_px, opacity);
    };
    this.lines = [line(1, this.ofProfile, 1.2, 0.7, () => grey),
      line(this.ofProfile, count, 2.4, 1, (share) => ramp("path", share))];
    this.object.add(...this.lines);
  }

  show(samples: number, showsProfile: boolean, showsViews: boolean) {
    const [profile, views] = this.lines;
    profile.visible = showsProfile;
    views.visible = showsViews;
    profile.geometry.instanceCount = Math.max(0, Math.min(samples, this.ofProfile) - 1);
    views.geometry.instanceCount = Math.max(0, samples - this.ofProfile);
  }
}

/** Corners of a camera's picture, `depth` metres in front of it, where `T` puts it. */
function pictureCorners({ fov_x, fov_y }: CameraData, T: three.Matrix4, depth: number) {
  const [x, y] = [depth * Math.tan(fov_x / 2), depth * Math.tan(fov_y / 2)];
  return [[-x, -y], [x, -y], [x, y], [-x, y]].map(([u, v]) =>
    new three.Vector3(u, v, depth).applyMatrix4(T));
}

/** Ends of the lines of its pyramid. */
function pyramidEdges(camera: CameraData, T: three.Matrix4, depth: number): three.Vector3[] {
  const corners = pictureCorners(camera, T, depth);
  const apex = new three.Vector3().setFromMatrixPosition(T);
  return corners.flatMap((corner, i) => [apex, corner, corner, corners[(i + 1) % 4]]);
}

/** Small pyramids of every view; show(n) leaves the first n. */
export class FrustaMark {
  readonly object: three.LineSegments;
  readonly perView: number; // ends of lines

  constructor(flight: Flight) {
    const { count } = flight;
    const edges = Array.from({ length: count }, (_, view) => flight.camerasInWorld(view)
      .flatMap(({ camera, T }) => pyramidEdges(camera, T, 0.9)));
    const colours = edges.flatMap((ofView, view) => {
      const rgb = ramp("path", view / Math.max(1, count - 1)).toArray();
      return ofView.flatMap(() => rgb);
    });
    this.perView = edges[0]?.length ?? 0;
    this.object = makeLines(numbersOf(edges.flat()), colours, 0.8);
  }

  show(views: number) { this.object.geometry.setDrawRange(0, views * this.perView); }
}

const kSoon = 5; // of planned views, whose line and pyramids stand out
const kPoseNumbers = 7;

/** What a tour still means to do: the line through its views, and what the next ones look at. */
export class PlanMark extends ViewMark {
  places: three.Vector3[] = []; // of the views that are drawn

  constructor(private readonly flight: Flight) { super(); }

  protected parts(n: number): three.Object3D[] {
    const { data: { plan, cameras: [camera] }, size_m } = this.flight;
    const { poses, ranges } = plan!;
    const [begin, end] = n > 0 ? ranges.subarray(2 * n - 2, 2 * n) : [0, 0];
    this.places = Array.from({ length: end - begin }, (_, i) =>
      new three.Vector3().fromArray(poses, kPoseNumbers * (begin + i)));
    if (n === 0) return [];
    const { places } = this;
    const from = [this.flight.viewPose(n - 1).p, ...places];
    const ways = places.map((place, i) => [from[i], place]);
    const pyramids = places.slice(0, kSoon).flatMap((place, i) => {
      const q = new three.Quaternion().fromArray(poses, kPoseNumbers * (begin + i) + 3);
      return pyramidEdges(camera,
        new three.Matrix4().makeRotationFromQuaternion(q).setPosition(place), 0.035 * size_m);
    });
    const colour = colourOf("plan");
    return [makeTube(numbersOf(ways.slice(0, kSoon).flat()), colour, 2.6),
      makeLines(numbersOf(pyramids), colour),
      makeTube(numbersOf(ways.slice(kSoon).flat()), colour, 1.3, 0.6),
      makeDots(numbersOf(places.slice(kSoon)), colour, 5)];
  }
}

/** What the cameras see, on the vehicle's pose. */
export class SightMark extends ViewMark {
  constructor(private readonly flight: Flight) { super(); }

  protected parts(n: number): three.Object3D[] {
    const colour = colourOf("camera");
    return this.flight.camerasAt(Math.max(0, n - 1)).flatMap((camera) => {
      const T = new three.Matrix4().fromArray(camera.T_body_camera);
      const depth = Math.min(camera.range_m, this.flight.sight_m);
      const edges = pyramidEdges(camera, T, depth);
      const corners = pictureCorners(camera, T, depth);
      const sides = corners.flatMap((corner, i) => [edges[0], corner, corners[(i + 1) % 4]]);
      return [makeLines(numbersOf(edges), colour, 0.75),
        new three.Mesh(geometryOf(numbersOf(sides), colour), new three.MeshBasicMaterial({
          color: colour, transparent: true, opacity: 0.07, depthWrite: false,
          side: three.DoubleSide }))];
    });
  }
}
