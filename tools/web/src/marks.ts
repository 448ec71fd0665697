// Lines and dots of the mission: flown path, views, camera pyramids.
import * as three from "three";
import { LineMaterial } from "three/addons/lines/LineMaterial.js";
import { LineSegments2 } from "three/addons/lines/LineSegments2.js";
import { LineSegmentsGeometry } from "three/addons/lines/LineSegmentsGeometry.js";
import { colourOf, ramp } from "./colours";
import type { CameraData } from "./data";
import { lastAtMost, type Flight } from "./flight";
import { cornersOfViews } from "./path_line";

type Numbers = ArrayLike<number>;

/** Lines of that width; six numbers a segment, of places and of colours. */
export function makeTube(positions: Numbers, colours: Numbers, width_px: number, opacity = 1) {
  const geometry = new LineSegmentsGeometry();
  if (positions.length > 0) {
    geometry.setPositions(Float32Array.from(positions)).setColors(Float32Array.from(colours));
  }
  const tube = new LineSegments2(geometry, new LineMaterial({ linewidth: width_px,
    vertexColors: true, transparent: opacity < 1, opacity }));
  tube.frustumCulled = false;
  return tube;
}

/** Of places and, where there are any, colours and corners of faces; x y z or r g b each. */
export function geometryOf(places: Numbers, colours: Numbers | null = null,
    corners: number[] | null = null): three.BufferGeometry {
  const geometry = new three.BufferGeometry();
  const attribute = (values: Numbers) => new three.BufferAttribute(Float32Array.from(values), 3);
  geometry.setAttribute("position", attribute(places));
  if (colours) geometry.setAttribute("color", attribute(colours));
  return corners ? geometry.setIndex(corners) : geometry;
}

/** Of one colour, as many numbers as there are places; else as they are. */
function coloursOf(places: Numbers, colours: Numbers | number): Numbers {
  if (typeof colours !== "number") return colours;
  const rgb = new three.Color(colours).toArray();
  return Array.from({ length: places.length }, (_, i) => rgb[i % 3]);
}

/** Thin ones; three numbers an end, of places and, where they are not of one, of colours. */
export function makeLines(places: Numbers, colours: Numbers | number, opacity = 1) {
  // all with colours of their own and blended: of one kind, whose shader is compiled once
  const lines = new three.LineSegments(geometryOf(places, coloursOf(places, colours)),
    new three.LineBasicMaterial({ vertexColors: true, transparent: true, opacity,
      depthWrite: opacity > 0.5 }));
  lines.frustumCulled = false;
  return lines;
}

/** Dots of that size; x y z each, of one colour or r g b each. */
export function makeDots(places: Numbers, colours: Numbers | number, size: number) {
  const dots = new three.Points(geometryOf(places, coloursOf(places, colours)),
    new three.PointsMaterial({ vertexColors: true, size, sizeAttenuation: false }));
  dots.frustumCulled = false;
  return dots;
}

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
    for (const part of this.parts(n)) this.object.add(part);
    this.object.traverse((part) => { part.layers.mask = this.object.layers.mask; });
  }

  protected abstract parts(n: number): three.Object3D[];

  /** What else it depends on. */
  protected variant(): string { return ""; }
}

/** A piece of the path: the samples that are its corners, and the line through them. */
interface Piece {
  corners: number[];
  line: LineSegments2;
}

/**
 * The flown path, the profile's part of it thin and grey; show(n) leaves the first n samples, as
 * far as their last corner, and a straight end from there.
 */
export class PathMark {
  readonly object = new three.Group();
  private readonly pieces: Piece[]; // the profile, the views
  private readonly end = makeTube(new Float32Array(6), new Float32Array(6), 2.4);

  constructor(private readonly flight: Flight) {
    const count = (flight.points?.length ?? 0) / 3;
    const firstView = Math.min(flight.firstViewSample(), count);
    const grey = new three.Color(colourOf("profile"));
    this.pieces = [this.piece(0, firstView, 1.2, 0.7, () => grey),
      this.piece(Math.max(0, firstView - 1), count, 2.4, 1, (share) => ramp("path", share))];
    this.object.add(...this.pieces.map(({ line }) => line), this.end);
  }

  private piece(begin: number, end: number, width_px: number, opacity: number,
      colourOfShare: (share: number) => three.Color): Piece {
    const corners = cornersOfViews(this.flight, begin, end);
    const positions: number[] = [];
    const colours: number[] = [];
    for (let i = 0; i + 1 < corners.length; ++i) {
      const rgb = colourOfShare((corners[i] - begin) / (end - begin)).toArray();
      positions.push(...this.sample(corners[i]), ...this.sample(corners[i + 1]));
      colours.push(...rgb, ...rgb);
    }
    return { corners, line: makeTube(positions, colours, width_px, opacity) };
  }

  private sample(i: number) { return this.flight.points!.subarray(3 * i, 3 * i + 3); }

  show(samples: number, showsProfile: boolean, showsViews: boolean) {
    this.end.visible = false;
    this.pieces.forEach(({ corners, line }, i) => {
      const last = lastAtMost(corners, samples - 1);
      line.geometry.instanceCount = Math.max(0, last);
      const isShown = i === 0 ? showsProfile : showsViews;
      line.visible = isShown && last > 0;
      const isBetween = last >= 0 && last + 1 < corners.length && samples - 1 > corners[last];
      if (!isShown || !isBetween) return;
      const colours = line.geometry.getAttribute("instanceColorStart");
      const at = Math.min(last, colours.count - 1);
      const rgb = [colours.getX(at), colours.getY(at), colours.getZ(at)];
      this.end.geometry.setPositions([...this.sample(corners[last]), ...this.sample(samples - 1)])
        .setColors([...rgb, ...rgb]);
      this.end.material.linewidth = line.material.linewidth;
      this.end.visible = true;
    });
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

const numbersOf = (points: three.Vector3[]) => points.flatMap((point) => point.toArray());

/** Small pyramids of every view; show(n) leaves the first n. */
export class FrustaMark {
  readonly object: three.LineSegments;
  private readonly perView: number;

  constructor(flight: Flight) {
    const positions: number[] = [];
    const colours: number[] = [];
    for (let view = 0; view < flight.count; ++view) {
      const rgb = ramp("path", view / Math.max(1, flight.count - 1)).toArray();
      for (const { camera, T } of flight.camerasInWorld(view)) {
        for (const edge of pyramidEdges(camera, T, 0.9)) {
          positions.push(...edge.toArray());
          colours.push(...rgb);
        }
      }
    }
    this.perView = positions.length / 3 / Math.max(1, flight.count);
    this.object = makeLines(positions, colours, 0.8);
  }

  show(views: number) { this.object.geometry.setDrawRange(0, views * this.perView); }

  /** Ends of the lines of a view, x y z each. */
  lines(view: number): number[] {
    const { array } = this.object.geometry.getAttribute("position");
    return [...array.slice(3 * view * this.perView, 3 * (view + 1) * this.perView)];
  }
}

/** What a tour still means to do: the line through its views, and what the next ones look at. */
export class PlanMark extends ViewMark {
  count = 0; // of views drawn
  private begin = 0; // of them, among the poses
  private static readonly kSoon = 5; // views whose line and pyramids stand out
  private static readonly kPoseNumbers = 7;

  constructor(private readonly flight: Flight) { super(); }

  protected parts(n: number): three.Object3D[] {
    const { ranges } = this.flight.data.plan!;
    const [begin, end] = n > 0 ? ranges.subarray(2 * n - 2, 2 * n) : [0, 0];
    [this.begin, this.count] = [begin, end - begin];
    if (this.count === 0) return [];
    const soonEnd = Math.min(begin + PlanMark.kSoon, end);
    return [this.line(this.flight.viewPose(n - 1).p, begin, soonEnd, 2.6, 1),
      this.pyramids(begin, soonEnd), ...soonEnd === end ? []
        : [this.line(this.place(soonEnd - 1), soonEnd, end, 1.3, 0.6),
          makeDots(numbersOf(this.places(soonEnd, end)), colourOf("plan"), 5)]];
  }

  /** Places (x y z each) of the views that are drawn. */
  drawn(): number[] { return numbersOf(this.places(this.begin, this.begin + this.count)); }

  private place(pose: number) {
    const { poses } = this.flight.data.plan!;
    return new three.Vector3().fromArray(poses, PlanMark.kPoseNumbers * pose);
  }

  private places(begin: number, end: number) {
    return Array.from({ length: end - begin }, (_, i) => this.place(begin + i));
  }

  private line(from: three.Vector3, begin: number, end: number, width_px: number, opacity: number) {
    const places = [from, ...this.places(begin, end)];
    const ends = places.slice(1).flatMap((place, i) => [places[i], place]);
    const rgb = new three.Color(colourOf("plan")).toArray();
    return makeTube(numbersOf(ends), ends.flatMap(() => rgb), width_px, opacity);
  }

  private pyramids(begin: number, end: number) {
    const { data: { plan, cameras: [camera] } } = this.flight;
    const depth = 0.035 * this.flight.workspace().size_m;
    return makeLines(numbersOf(this.places(begin, end).flatMap((place, i) => {
      const q = new three.Quaternion()
        .fromArray(plan!.poses, PlanMark.kPoseNumbers * (begin + i) + 3);
      return pyramidEdges(camera,
        new three.Matrix4().makeRotationFromQuaternion(q).setPosition(place), depth);
    })), colourOf("plan"));
  }
}

/** What the cameras see, out to their range or to `most_m`, on the vehicle's pose. */
export class SightMark extends ViewMark {
  constructor(private readonly flight: Flight, private readonly most_m: number) { super(); }

  protected parts(n: number): three.Object3D[] {
    const colour = colourOf("camera");
    return this.flight.camerasAt(Math.max(0, n - 1)).flatMap((camera) => {
      const T = new three.Matrix4().fromArray(camera.T_body_camera);
      const depth = Math.min(camera.range_m, this.most_m);
      const edges = pyramidEdges(camera, T, depth);
      const corners = pictureCorners(camera, T, depth);
      const sides = corners.flatMap((corner, i) => [edges[0], corner, corners[(i + 1) % 4]]);
      return [makeLines(numbersOf(edges), colour, 0.75),
        new three.Mesh(geometryOf(numbersOf(sides)), new three.MeshBasicMaterial({ color: colour,
          transparent: true, opacity: 0.07, depthWrite: false, side: three.DoubleSide }))];
    });
  }
}
