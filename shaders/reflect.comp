#version 430 core
// What the receiver of each vertex sends to the eye of all that arrives, as prt/relight/glossy_relighter.h has it:
//
//   B(ω_o) = Σ_i f_i(ω_o) l_i                                              [Sloan02, 5; Kautz02]
//
// BAND_COUNT  of incident radiance
// SPLIT       1: some receivers are split
// BOUNCED     1: and what has bounced is shown by them; 0: nothing has

layout(local_size_x = 64) in;

const float kHalfPi = 1.57079632679490;
const float kDielectricF0 = 0.04;
const uint kCoefficientCount = BAND_COUNT * BAND_COUNT;
const uint kUprightCount = BAND_COUNT * (BAND_COUNT + 1) / 2;
const uint kPairCount = BAND_COUNT * (BAND_COUNT - 1) / 2;

const uint kSplit = 1u;
const uint kOther = 2u;

struct Receiver {
    vec3 position;
    uint kind;
    vec3 normal;
    uint firstElement;  // of its material, and of the level below its roughness
    float levelShare;   // of the level above
    float metallic;
    uint viewCount;
    uint padding;
};

struct ExitRadiance {
    vec4 perBaseColor;  // and mirrorVisibility
    vec4 constant;
};

layout(location = 2) uniform uint receiverCount;
layout(location = 3) uniform uint vertexCount;
layout(location = 4) uniform vec3 eye;
layout(location = 8) uniform float open[BAND_COUNT];  // white light as it would arrive unshadowed, of m = 0

layout(std430, binding = 0) readonly buffer Receivers { Receiver receivers[]; };
layout(std430, binding = 1) readonly buffer Vertices { uint receiverOfVertex[]; };
// Of glTF's materials [level][view][l, m ≥ 0]: GGX of F0 = 0 and F0 = 1, a layered Lambert lobe. Of others
// [view][l, m ≥ 0]: red, green and blue.
layout(std430, binding = 2) readonly buffer Elements { vec4 elements[]; };
layout(std430, binding = 3) readonly buffer Incident { float incident[]; };  // [colour, place][receiver]
layout(std430, binding = 4) writeonly buffer Relit { ExitRadiance relitVertices[]; };
#if SPLIT
layout(std430, binding = 5) readonly buffer Arriving { float arriving[]; };  // of white light, straight from it
#if BOUNCED
layout(std430, binding = 6) readonly buffer Direct { float direct[]; };  // of the light, straight from it
#endif
#endif

// ω_o in the receiver's frame (frameFromNormal).
vec3 viewReceiver(Receiver receiver) {
    vec3 toEye = eye - receiver.position;
    float distanceToEye = length(toEye);
    toEye = distanceToEye > 0.0 ? toEye / distanceToEye : vec3(0.0);
    vec3 n = receiver.normal;
    float s = floatBitsToInt(n.z) < 0 ? -1.0 : 1.0;
    float a = -1.0 / (s + n.z);
    float b = n.x * n.y * a;
    vec3 tangent = vec3(1.0 + s * n.x * n.x * a, s * b, -s * n.x);
    vec3 bitangent = vec3(b, s + n.y * n.y * a, -n.y);
    return vec3(dot(toEye, tangent), dot(toEye, bitangent), dot(toEye, n));
}

// Among a table's views, from 0 to 1 (placeView).
float placeView(vec3 view) {
    float fromHorizon = view.z > 0.0 ? atan(view.z, length(view.xy)) : 0.0;
    return max(1.0 - sqrt(fromHorizon / kHalfPi), 0.0);
}

struct Turn {
    uint place;    // of (l, m)
    uint partner;  // and (l, −m)
    float cosine;
    float sine;
};

Turn turnTo(int l, int m, vec2 azimuth) {
    uint place = m == 0 ? uint(l) : uint(BAND_COUNT + l * (l - 1) / 2 + m - 1);
    return Turn(place, m == 0 ? place : place + kPairCount, azimuth.x, azimuth.y);
}

// cos mφ l_(l,m) + sin mφ l_(l,−m)
#define READ_TURNED(radiance, color, receiver, turn)                                           \
    ((turn).cosine * radiance[(color * kCoefficientCount + (turn).place) * receiverCount + receiver] + \
     (turn).sine * radiance[(color * kCoefficientCount + (turn).partner) * receiverCount + receiver])

void main() {
    uint vertex = gl_GlobalInvocationID.x;
    if (vertex >= vertexCount) return;
    uint r = receiverOfVertex[vertex];
    Receiver receiver = receivers[r];
    vec3 view = viewReceiver(receiver);
    float aside = length(view.xy);
    vec2 azimuthStep = aside > 0.0 ? view.xy / aside : vec2(1.0, 0.0);

    float place = placeView(view) * float(receiver.viewCount - 1u);
    uint firstView = min(uint(place), receiver.viewCount - 2u);
    float viewShare = place - float(firstView);
    uint low = receiver.firstElement + firstView * kUprightCount;
    uint high = low + receiver.viewCount * kUprightCount;

    float metallic = receiver.metallic;
    float coat = kDielectricF0 * (1.0 - metallic);
    float base = (1.0 - kDielectricF0) * (1.0 - metallic);
    vec3 perBaseColor = vec3(0.0);
    vec3 constant = vec3(0.0);
    float arrivingSum = 0.0;
    float openSum = 0.0;
    vec2 azimuth = vec2(1.0, 0.0);  // cos mφ and sin mφ
    for (int m = 0; m < BAND_COUNT; ++m) {
        for (int l = m; l < BAND_COUNT; ++l) {
            Turn turn = turnTo(l, m, azimuth);
            uint element = uint(l * (l + 1) / 2 + m);
            vec3 all = vec3(READ_TURNED(incident, 0u, r, turn), READ_TURNED(incident, 1u, r, turn),
                            READ_TURNED(incident, 2u, r, turn));
            vec3 response = mix(elements[low + element].rgb, elements[low + kUprightCount + element].rgb, viewShare);
            if (receiver.kind == kOther) {
                constant += response * all;
                continue;
            }
            vec3 above = mix(elements[high + element].rgb, elements[high + kUprightCount + element].rgb, viewShare);
            response = mix(response, above, receiver.levelShare);
            float range = response.g - response.r;
            perBaseColor += base * response.b * all;
#if SPLIT
            if (receiver.kind == kSplit) {
                arrivingSum += response.g * READ_TURNED(arriving, 0u, r, turn);
                if (m == 0) openSum += response.g * open[l];
#if BOUNCED
                all -= vec3(READ_TURNED(direct, 0u, r, turn), READ_TURNED(direct, 1u, r, turn),
                            READ_TURNED(direct, 2u, r, turn));
#else
                all = vec3(0.0);
#endif
            }
#endif
            perBaseColor += metallic * range * all;
            constant += (response.r + coat * range) * all;
        }
        azimuth = vec2(azimuth.x * azimuthStep.x - azimuth.y * azimuthStep.y,
                       azimuth.x * azimuthStep.y + azimuth.y * azimuthStep.x);
    }
    float mirrorVisibility = openSum > 0.0 ? clamp(arrivingSum / openSum, 0.0, 1.0) : 0.0;
    relitVertices[vertex] = ExitRadiance(vec4(perBaseColor, mirrorVisibility), vec4(constant, 0.0));
}
