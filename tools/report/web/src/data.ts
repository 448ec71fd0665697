// What the program wrote into the page: JSON beside blocks of bytes (tools/report/run_json.cpp).

export type Slice = [at: number, count: number];
export type Vec3 = [number, number, number];

export interface PackedPoints {
  min: Vec3;
  size: Vec3;
  steps: Slice; // uint16 (n, 3)
}

export interface Table {
  title: string;
  columns: { head: string; is_number: boolean }[];
  rows: string[][];
  notes: string[];
}

/** The voxels of the true surface that there are to find (tools/report/true_surface.hpp). */
export interface SurfaceData {
  size_m: number;
  index: Slice; // int16 (n, 3)
}

/** Of all decisions, in the order of their views (tools/report/candidate_pack.hpp). */
export interface CandidateData {
  points: PackedPoints;
  angles: Slice; // float32 (n, 2): yaw, pitch
  kind: Slice; // uint8: a reason's number, 254 valid, 255 chosen
  terms: Slice; // float32 (valid and chosen ones, 5)
  begins: Slice; // uint32 (views + 1)
  reasons: { words: string; colour: number }[];
}

/** Of one kind of voxels (tools/report/belief_pack.hpp). */
export interface BeliefListData {
  runs: Slice; // uint8
  begins: Slice; // uint32 (views + 1)
  counts: Slice; // uint32 (views)
}

export interface BeliefData {
  size_m: number; // of the cells
  map_m: number; // of the map's voxels
  low: Vec3;
  cells: Vec3;
  unknown: BeliefListData | null;
  predicted: BeliefListData | null;
  frontier: BeliefListData | null;
  looked_at: BeliefListData | null;
}

export interface MeshData {
  vertices: PackedPoints;
  all_faces: number;
  parts: { rgb: Vec3; corners: Slice }[]; // uint32, three a face
  surface: SurfaceData | null;
}

export interface CameraData {
  name: string;
  fov_x: number;
  fov_y: number;
  range_m: number;
  T_body_camera: number[]; // 4 x 4, column by column; x right, y down, z forward
}

/** A column a key, a row a view. */
export interface Views {
  x: number[];
  y: number[];
  z: number[];
  yaw: number[];
  time: number[];
  seconds: number[]; // from the first view on, as the metres
  metres: number[];
  sampler: string[];
  candidates: number[];
  valid: number[];
  utility: number[];
  information: number[];
  density_term: number[];
  prediction: number[];
  distance_factor: number[];
  entropy: number[];
  density: number[];
  points: number[];
  T_body_camera?: number[][][]; // of each camera, where a gimbal turns some
}

export interface Figures {
  termination: string;
  iterations: number;
  entropy_reduction: number;
  straight_m: number;
  profile_m: number;
  flight_time_s: number;
  energy_wh: number;
  coverage: Vec3;
  f_5cm: number;
  density: number;
  version: string;
  result_sha256: string;
  curve: { coverage: Vec3[] };
}

/** What tools/report/voxel_growth.hpp says. */
export interface VoxelData {
  size_m: number;
  index: Slice;
  after: Slice;
  gain_step: Slice;
  gain_points: Slice;
  gains_after: Slice;
}

/** Where the paper's mission ended. */
export interface PaperEnd {
  label: string;
  views: number;
  metres?: number;
  seconds?: number;
  coverage_percent?: Vec3;
  is_doubtful?: boolean; // the table's notes say why
  density?: number;
}

export type Thumbnail = [view: number, camera: string, width: number, height: number, at: number,
  bytes: number, depthAt: number, depthBytes: number];

export interface RunData {
  label: string;
  slot: number; // of its method: which colour is its own
  structure: string;
  utility: string;
  preset: string;
  seed: number;
  folder: string;
  command: string;
  yaml: string;
  missing: string[];
  workspace: { min: Vec3; max: Vec3 };
  has_ground: boolean;
  profile_end_s: number | null;
  views_begin_s: number | null;
  mesh: number;
  cameras: CameraData[];
  vehicle: { rotors: Vec3[]; radius_m: number };
  views: Views;
  figures: Figures | null;
  ceiling: [number, number | null, number | null] | null; // coverage in reach, by voxel size
  paper: PaperEnd | null;
  cloud: { points: PackedPoints; after: Slice; all_points: number; cell_m: number; colour?: Slice;
    error?: Slice } | null; // of errors uint8, in millimetres; 255: not of the structure
  found: Slice | null; // uint16: of the surface's voxels the views until each was found
  candidates: CandidateData | null;
  beliefs: BeliefData | null;
  surface: Slice | null; // uint8: surface.glb
  voxels: VoxelData | null;
  path: { points: PackedPoints; time: Slice; quaternion: Slice } | null;
  plan: { poses: Slice; ranges: Slice } | null; // of tours; see PackedPlan (run_pack.hpp)
  frames: Thumbnail[];
}

/** 256 sRGB colours, three bytes each (tools/render/colour.hpp). */
export type RampName = "path" | "amount" | "score";

export interface PageData {
  title: string;
  is_live: boolean; // served while the mission flies
  version: string;
  ramps: Record<RampName, number[]>;
  tables: Table[];
  meshes: MeshData[];
  runs: RunData[];
}

/** The arrays of one block. */
export class Bytes {
  private readonly buffer: ArrayBuffer;

  constructor(elementId: string) {
    const text = atob(document.getElementById(elementId)!.textContent!);
    const bytes = new Uint8Array(text.length);
    for (let i = 0; i < text.length; ++i) bytes[i] = text.charCodeAt(i);
    this.buffer = bytes.buffer;
  }

  u8([at, count]: Slice) { return new Uint8Array(this.buffer, at, count); }
  u16([at, count]: Slice) { return new Uint16Array(this.buffer, at, count); }
  i16([at, count]: Slice) { return new Int16Array(this.buffer, at, count); }
  u32([at, count]: Slice) { return new Uint32Array(this.buffer, at, count); }
  f32([at, count]: Slice) { return new Float32Array(this.buffer, at, count); }

  /** Metres, x y z of each point. */
  points({ min, size, steps }: PackedPoints): Float32Array {
    const packed = this.u16(steps);
    const points = new Float32Array(packed.length);
    for (let i = 0; i < packed.length; ++i) {
      points[i] = min[i % 3] + size[i % 3] * packed[i] / 65535;
    }
    return points;
  }
}

export function readPage(): PageData {
  return JSON.parse(document.getElementById("data")!.textContent!) as PageData;
}
