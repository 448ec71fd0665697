// GLSL 3.30 sources of the passes that go over the whole picture.
#pragma once

namespace gnbv::shaders {

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
