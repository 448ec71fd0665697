// GLSL 3.30 sources. All colours are linear; the multisampled target encodes to sRGB by itself.
#pragma once

namespace gnbv::shaders {

/// Precedes every other source: the block that all programs share (std140, as FrameBlock).
inline constexpr const char* kCommon = R"(#version 330 core
layout(std140) uniform Frame {
  mat4 clip_from_world;
  mat4 shadow_from_world;   // to [0, 1] in all three
  vec4 eye;                 // xyz world; w = view height in px of the supersampled target
  vec4 to_light;            // xyz world, unit; w = side of a shadow texel, m
  vec4 to_fill;             // xyz world, unit; w = 1 / tan(fov_y / 2)
  vec4 camera_right;        // xyz world; w = width of the shadowed square, m
  vec4 camera_up;           // xyz world; w = side of the shadow map, px
  vec4 ground;              // centre x, y, height z, radius
  vec4 grid;                // minor, major; depth where haze begins and its range, m
  vec4 lens;                // tangents of the half angles across and up; depth of near and far, m
  vec4 hollow;              // radius of ambient occlusion, m; 1 where a ground is drawn; shading
};
)";

/// Lighting of every solid thing.
inline constexpr const char* kLighting = R"(
uniform sampler2DShadow shadow_map;

// outermost first, so that the first four tell a penumbra from an even surface
const vec2 kDisc[12] = vec2[](
  vec2(-0.840, -0.074), vec2(0.962, -0.195), vec2(0.185, -0.893), vec2(0.203, 0.890),
  vec2(-0.696, 0.457), vec2(-0.326, -0.406), vec2(0.473, -0.480), vec2(0.519, 0.767),
  vec2(0.507, 0.064), vec2(0.896, 0.412), vec2(-0.322, -0.933), vec2(-0.203, 0.350));

// share of the key light that arrives, by percentage closer filtering over `spread` texels
float key_share(vec3 p, vec3 n, float spread) {
  float slope = 1.0 - clamp(dot(n, to_light.xyz), 0.0, 1.0);
  vec3 lifted = p + n * to_light.w * (1.0 + 2.5 * slope);
  vec3 s = (shadow_from_world * vec4(lifted, 1.0)).xyz;
  if (any(notEqual(s.xy, clamp(s.xy, 0.0, 1.0)))) return 1.0;
  s.z = min(s.z, 1.0);
  float step_uv = spread / camera_up.w;
  float sum = 0.0;
  for (int i = 0; i < 4; ++i) sum += texture(shadow_map, vec3(s.xy + kDisc[i] * step_uv, s.z));
  if (sum == 0.0 || sum == 4.0) return sum / 4.0;
  for (int i = 4; i < 12; ++i) sum += texture(shadow_map, vec3(s.xy + kDisc[i] * step_uv, s.z));
  return sum / 12.0;
}

vec3 lit(vec3 albedo, vec3 n, vec3 p, float gloss) {
  vec3 l = to_light.xyz;
  vec3 v = normalize(eye.xyz - p);
  float facing = max(dot(n, l), 0.0);
  float key = facing > 0.0 ? facing * key_share(p, n, 1.8) : 0.0;
  float fill = max(dot(n, to_fill.xyz), 0.0);
  vec3 ambient = mix(vec3(0.15, 0.145, 0.14), vec3(0.33, 0.355, 0.39), 0.5 + 0.5 * n.z);
  vec3 light = ambient + key * vec3(0.84, 0.81, 0.76) + fill * vec3(0.09, 0.10, 0.12);
  // grazing surfaces darken a little, which draws outlines where structure covers structure
  float grazing = 1.0 - abs(dot(n, v));
  light *= 1.0 - 0.45 * grazing * grazing * grazing;
  light = mix(vec3(0.95), light, hollow.z);
  float shine = hollow.z * pow(max(dot(n, normalize(l + v)), 0.0), 48.0) * gloss * key;
  // a little air between near and far things, for depth
  float depth = dot(p - eye.xyz, cross(camera_up.xyz, camera_right.xyz));
  float haze = 0.20 * hollow.z * clamp((depth - grid.z) / grid.w, 0.0, 1.0);
  vec3 c = albedo * light + vec3(shine);
  // white paint in full light keeps its shape instead of clipping
  c = mix(c, 1.0 - 0.3 * exp((0.7 - c) / 0.3), step(0.7, c));
  return mix(c, vec3(0.74, 0.76, 0.79), haze);
}
)";

inline constexpr const char* kSolidVertex = R"(
layout(location = 0) in vec3 p_in;
layout(location = 1) in vec3 n_in;
layout(location = 2) in vec4 colour_in;
out vec3 p_world;
out vec3 n_world;
out vec4 colour;
void main() {
  p_world = p_in;
  n_world = n_in;
  colour = colour_in;
  gl_Position = clip_from_world * vec4(p_in, 1.0);
}
)";

inline constexpr const char* kSolidFragment = R"(
in vec3 p_world;
in vec3 n_world;
in vec4 colour;
uniform sampler2D paint;
out vec4 pixel;
void main() {
  if (dot(n_world, n_world) < 0.25) {  // no normal: not lit
    pixel = colour;
    return;
  }
  vec3 base = colour.rgb;
  if (colour.a > 1.5) {  // kPainted
    vec4 painted = texelFetch(paint, ivec2(gl_FragCoord.xy), 0);
    if (painted.a > 0.0) base = painted.rgb;
  }
  vec3 n = normalize(n_world);
  // both sides are lit alike: users' meshes are not always oriented
  if (!gl_FrontFacing) n = -n;
  pixel = vec4(lit(base, n, p_world, 0.10), colour.a);
}
)";

/// Balls: a square point each, on which the fragment finds the sphere.
inline constexpr const char* kBallVertex = R"(
layout(location = 0) in vec4 ball_in;    // centre, radius
layout(location = 1) in vec3 colour_in;
out vec4 ball;
out vec3 colour;
void main() {
  ball = ball_in;
  colour = colour_in;
  gl_Position = clip_from_world * vec4(ball_in.xyz, 1.0);
  gl_PointSize = max(1.0, ball_in.w * to_fill.w * eye.w / gl_Position.w);
}
)";

inline constexpr const char* kBallFragment = R"(
in vec4 ball;
in vec3 colour;
out vec4 pixel;
void main() {
  vec2 q = vec2(2.0, -2.0) * (gl_PointCoord - 0.5);
  float rr = dot(q, q);
  if (rr > 1.0) discard;
  vec3 to_eye = normalize(cross(camera_right.xyz, camera_up.xyz));
  vec3 n = normalize(q.x * camera_right.xyz + q.y * camera_up.xyz + sqrt(1.0 - rr) * to_eye);
  vec3 p = ball.xyz + ball.w * n;
  vec4 clip = clip_from_world * vec4(p, 1.0);
  gl_FragDepth = 0.5 + 0.5 * clip.z / clip.w;
  pixel = vec4(lit(colour, n, p, 0.10), 1.0);
}
)";

/// Dots of a cloud: discs along the surface, lit once a dot; without a normal they face the camera.
inline constexpr const char* kDotVertex = R"(
layout(location = 0) in vec4 dot_in;    // centre, radius
layout(location = 1) in vec3 n_in;
layout(location = 2) in vec3 colour_in;
flat out vec3 colour;
flat out vec4 disc;     // centre, radius
flat out vec3 n_view;   // along camera_right, camera_up, and to the eye
void main() {
  vec3 p = dot_in.xyz;
  disc = dot_in;
  vec3 to_eye = normalize(eye.xyz - p);
  vec3 n = dot(n_in, n_in) > 0.0 ? n_in : normalize(to_eye + to_light.xyz);
  if (dot(n, to_eye) < 0.0) n = -n;
  vec3 back = normalize(cross(camera_right.xyz, camera_up.xyz));
  n_view = vec3(dot(n, camera_right.xyz), dot(n, camera_up.xyz), max(0.25, dot(n, back)));
  if (dot(n_in, n_in) == 0.0) n_view = vec3(0.0, 0.0, 1.0);
  colour = lit(colour_in, n, p + 2.0 * dot_in.w * to_light.xyz, 0.0);
  gl_Position = clip_from_world * vec4(p, 1.0);
  gl_PointSize = max(1.5, dot_in.w * to_fill.w * eye.w / gl_Position.w);
}
)";

inline constexpr const char* kDotFragment = R"(
flat in vec3 colour;
flat in vec4 disc;
flat in vec3 n_view;
out vec4 pixel;
void main() {
  vec2 q = vec2(2.0, -2.0) * (gl_PointCoord - 0.5);
  vec3 on_disc = vec3(q, -dot(q, n_view.xy) / n_view.z);
  if (dot(on_disc, on_disc) > 1.0) discard;
  vec3 back = normalize(cross(camera_right.xyz, camera_up.xyz));
  vec3 p = disc.xyz + disc.w * (on_disc.x * camera_right.xyz + on_disc.y * camera_up.xyz +
                                on_disc.z * back);
  vec4 clip = clip_from_world * vec4(p, 1.0);
  gl_FragDepth = 0.5 + 0.5 * clip.z / clip.w;
  pixel = vec4(colour, 1.0);
}
)";

inline constexpr const char* kSolidShadowVertex = R"(
layout(location = 0) in vec3 p_in;
void main() { gl_Position = vec4(2.0 * (shadow_from_world * vec4(p_in, 1.0)).xyz - 1.0, 1.0); }
)";

inline constexpr const char* kSolidShadowFragment = R"(
void main() {}
)";

inline constexpr const char* kBallShadowVertex = R"(
layout(location = 0) in vec4 ball_in;
void main() {
  gl_Position = vec4(2.0 * (shadow_from_world * vec4(ball_in.xyz, 1.0)).xyz - 1.0, 1.0);
  gl_PointSize = max(1.0, 2.0 * ball_in.w / camera_right.w * camera_up.w);
}
)";

inline constexpr const char* kBallShadowFragment = R"(
void main() {
  vec2 q = 2.0 * (gl_PointCoord - 0.5);
  if (dot(q, q) > 1.0) discard;
}
)";

inline constexpr const char* kGroundVertex = R"(
out vec2 p_ground;
void main() {
  vec2 q = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
  p_ground = ground.xy + q * ground.w;
  gl_Position = clip_from_world * vec4(p_ground, ground.z, 1.0);
}
)";

inline constexpr const char* kGroundFragment = R"(
in vec2 p_ground;
out vec4 pixel;

// coverage of lines `width` wide every `spacing`, with the pixel's footprint as filter; lines
// thinner than the footprint turn pale instead of flickering
float lines(vec2 p, float spacing, float width) {
  vec2 footprint = max(fwidth(p), vec2(1e-6));
  vec2 wide = max(vec2(width), footprint);
  vec2 away = abs(fract(p / spacing - 0.5) - 0.5) * spacing;
  vec2 line = 1.0 - smoothstep(0.5 * wide - 0.5 * footprint, 0.5 * wide + 0.5 * footprint, away);
  line *= width / wide;
  line = mix(line, vec2(width / spacing), smoothstep(vec2(0.3), vec2(0.8), footprint / spacing));
  return 1.0 - (1.0 - line.x) * (1.0 - line.y);
}

void main() {
  float r = length(p_ground - ground.xy) / ground.w;
  float fade = 1.0 - smoothstep(0.30, 1.0, r);
  if (fade <= 0.0) discard;
  vec3 p = vec3(p_ground, ground.z);
  float shade = 1.0 - key_share(p, vec3(0.0, 0.0, 1.0), 3.0);
  float line = max(0.28 * lines(p_ground, grid.x, 0.03), 0.45 * lines(p_ground, grid.y, 0.06));
  // paint: darkening only, so that the plane itself melts into the background
  vec3 ink = mix(vec3(0.13, 0.15, 0.19), vec3(0.05, 0.06, 0.09), shade);
  float cover = max(line, 0.0);
  cover = 1.0 - (1.0 - cover) * (1.0 - 0.42 * shade);
  pixel = vec4(ink, cover * fade);
}
)";

// of the passes that go over the whole picture

/// Fills the picture with one triangle.
inline constexpr const char* kScreenVertex = R"(
void main() {
  vec2 q = vec2((gl_VertexID << 1) & 2, gl_VertexID & 2);
  gl_Position = vec4(q * 2.0 - 1.0, 0.0, 1.0);
}
)";

inline constexpr const char* kBackgroundFragment = R"(
out vec4 pixel;
void main() {
  float t = gl_FragCoord.y / eye.w;  // 0 at the bottom
  pixel = vec4(mix(vec3(0.60, 0.615, 0.63), vec3(0.90, 0.92, 0.94), smoothstep(0.0, 1.0, t)), 1.0);
}
)";

/// Depth along the optical axis, m, of the nearest thing in each pixel of the final size; the
/// ground counts where it is drawn. Rows from bottom to top.
inline constexpr const char* kDistanceFragment = R"(
uniform sampler2D depths;
out float distance_m;

float metres(float depth) {
  return 2.0 * lens.w * lens.z / (lens.w + lens.z - (2.0 * depth - 1.0) * (lens.w - lens.z));
}

void main() {
  ivec2 q = 2 * ivec2(gl_FragCoord.xy);
  float depth = min(min(texelFetch(depths, q, 0).r, texelFetch(depths, q + ivec2(1, 0), 0).r),
                    min(texelFetch(depths, q + ivec2(0, 1), 0).r,
                        texelFetch(depths, q + ivec2(1, 1), 0).r));
  distance_m = depth < 1.0 ? metres(depth) : 1e9;
  if (hollow.y == 0.0 || depth < 1.0) return;
  vec2 tangent = (2.0 * gl_FragCoord.xy / vec2(textureSize(depths, 0) / 2) - 1.0) * lens.xy;
  vec3 forward = cross(camera_up.xyz, camera_right.xyz);
  float falls = dot(vec3(tangent, 1.0), vec3(camera_right.z, camera_up.z, forward.z));
  if (falls < 0.0) distance_m = min(1e9, (ground.z - eye.z) / falls);
}
)";

/// Scalable ambient obscurance (McGuire, Mara, Luebke 2012), 16 taps on a spiral that turns from
/// pixel to pixel in blocks of 4 x 4; stronger than theirs by 1.4. 1: nothing near.
inline constexpr const char* kHollowFragment = R"(
uniform sampler2D distances;
out float open_share;

vec3 position(ivec2 q) {
  q = clamp(q, ivec2(0), textureSize(distances, 0) - 1);
  float z = texelFetch(distances, q, 0).r;
  vec2 tangent = (2.0 * (vec2(q) + 0.5) / vec2(textureSize(distances, 0)) - 1.0) * lens.xy;
  return vec3(tangent * z, z);
}

// the side on which the surface goes on
vec3 slope(vec3 p, vec3 before, vec3 after) {
  return abs(after.z - p.z) < abs(p.z - before.z) ? after - p : p - before;
}

void main() {
  ivec2 q = ivec2(gl_FragCoord.xy);
  vec3 p = position(q);
  open_share = 1.0;
  if (p.z >= 1e9) return;
  // over two pixels: the dots of a cloud are steps of one
  vec3 across = slope(p, position(q - ivec2(2, 0)), position(q + ivec2(2, 0)));
  vec3 up = slope(p, position(q - ivec2(0, 2)), position(q + ivec2(0, 2)));
  vec3 n = normalize(cross(up, across));
  if (n.z > 0.0) n = -n;
  float radius_m = hollow.x;
  float radius_px = radius_m * 0.5 * float(textureSize(distances, 0).y) / (lens.y * p.z);
  if (radius_px < 1.0) return;
  radius_px = min(radius_px, 0.12 * float(textureSize(distances, 0).y));
  float turn = 6.2831853 / 16.0 * float(((q.x & 3) * 4 + (q.y & 3)) * 7 % 16);
  float bias_m = 0.045 * radius_m + 0.0012 * p.z;
  float sum = 0.0;
  for (int i = 0; i < 16; ++i) {
    float share = (float(i) + 0.5) / 16.0;
    float angle = turn + 2.3999632 * float(i);
    ivec2 tap = q + ivec2(round(share * radius_px * vec2(cos(angle), sin(angle))));
    vec3 v = position(tap) - p;
    float vv = dot(v, v);
    float near = max(radius_m * radius_m - vv, 0.0);
    sum += near * near * near * max(dot(v, n) - bias_m, 0.0) / (0.01 * radius_m * radius_m + vv);
  }
  open_share = max(0.0, 1.0 - 7.0 * sum / (16.0 * pow(radius_m, 5.0)));
}
)";

/// Box filter over 2 x 2 in linear light, darkened in hollows, sRGB encoding, ordered dither
/// against bands; the first row written is the top one.
inline constexpr const char* kResolveFragment = R"(
uniform sampler2D picture;
uniform sampler2D distances;
uniform sampler2D shade;
out vec4 pixel;
vec3 encode(vec3 l) {
  return mix(12.92 * l, 1.055 * pow(max(l, 1e-6), vec3(1.0 / 2.4)) - 0.055, step(0.0031308, l));
}
float bayer2(ivec2 a) { return float((2 * a.x + 3 * a.y) & 3); }

// mean over 4 x 4 pixels, which takes the turning of the taps away, on this side of any edge
float open_share(ivec2 q) {
  ivec2 last = textureSize(shade, 0) - 1;
  float z = texelFetch(distances, q, 0).r;
  float sum = 0.0, weight = 0.0;
  for (int dy = -2; dy < 2; ++dy) {
    for (int dx = -2; dx < 2; ++dx) {
      ivec2 tap = clamp(q + ivec2(dx, dy), ivec2(0), last);
      float w = abs(texelFetch(distances, tap, 0).r - z) < 0.5 * hollow.x ? 1.0 : 0.001;
      sum += w * texelFetch(shade, tap, 0).r;
      weight += w;
    }
  }
  return sum / weight;
}

void main() {
  ivec2 out_px = ivec2(gl_FragCoord.xy);
  ivec2 of_picture = ivec2(out_px.x, textureSize(picture, 0).y / 2 - 1 - out_px.y);
  ivec2 q = 2 * of_picture;
  vec3 sum = texelFetch(picture, q, 0).rgb + texelFetch(picture, q + ivec2(1, 0), 0).rgb +
             texelFetch(picture, q + ivec2(0, 1), 0).rgb + texelFetch(picture, q + ivec2(1, 1), 0).rgb;
  float dither = (4.0 * bayer2(out_px & 1) + bayer2((out_px >> 1) & 1) + 0.5) / 16.0 - 0.5;
  pixel = vec4(encode(0.25 * open_share(of_picture) * sum) + dither / 255.0, 1.0);
}
)";

}  // namespace gnbv::shaders
