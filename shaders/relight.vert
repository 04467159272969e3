#version 430 core
// Relights the receiver of each vertex, and places the vertex in the picture.
//
//   B(x) = Σ_i T_i(x) L_i                     of vectors                   [Sloan02]
//   B(x) = R_k0 + Σ_p w_p(x) R_kp             of clusters                  [Sloan03]
//
// RELIT         1: what each vertex sends has been made elsewhere; 0: it is made here
// STORED_BYTES  of a number: 4 is a float, 2 and 1 are integers as they stand
// MIRRORED      defined: surfaces show what their mirrorVisibility lets through
// CLUSTERED     1: a row is its cluster k and weights w_p; 0: coefficients, [channel][i]

layout(location = 0) in vec3 position;
layout(location = 1) in vec4 uvSets;  // two of them
layout(location = 2) in vec4 color;
#ifdef MIRRORED
layout(location = 3) in vec3 normal;
#endif

layout(location = 0) uniform mat4 clipFromEyeSpace;  // world axes, origin at the eye
layout(location = 1) uniform vec3 eye;

#if RELIT
struct ExitRadiance {
    vec4 perBaseColor;  // as it is multiplied by base colour, and mirrorVisibility
    vec4 constant;      // and as it is not
};
layout(std430, binding = 0) readonly buffer Relit { ExitRadiance relitVertices[]; };
#else
layout(location = 2) uniform uint receiverCount;
layout(location = 3) uniform uint panelCount;

// Numbers of all receivers in panels of four columns: [panel][receiver][4].
layout(std430, binding = 0) readonly buffer Transfer { uint words[]; };
layout(std430, binding = 1) readonly buffer Receivers { uint receiverOfVertex[]; };

#if CLUSTERED
layout(std430, binding = 2) readonly buffer Products { vec4 products[]; };           // R_kp
layout(std430, binding = 3) readonly buffer FirstProducts { uint firstProducts[]; };  // of k
#else
// A column a channel: what it makes of a panel's four numbers, as they are stored.
layout(std430, binding = 2) readonly buffer Light { mat3x4 light[]; };
layout(location = 4) uniform vec3 biasRadiance;  // what the columns' biases make
#endif
#endif

out vec3 radiancePerBaseColor;
out vec3 constantRadiance;
out vec4 uvs;
out vec4 vertexColor;
#ifdef MIRRORED
out float mirrorVisibility;
out vec3 surfaceNormal;
out vec3 towardsEye;
#endif

#if !RELIT
vec4 readNumbers(uint panel, uint receiver) {
    uint place = panel * receiverCount + receiver;
#if STORED_BYTES == 4
    return vec4(uintBitsToFloat(words[4u * place]), uintBitsToFloat(words[4u * place + 1u]),
                uintBitsToFloat(words[4u * place + 2u]), uintBitsToFloat(words[4u * place + 3u]));
#elif STORED_BYTES == 2
    uint low = words[2u * place];
    uint high = words[2u * place + 1u];
    return vec4(low & 0xffffu, low >> 16, high & 0xffffu, high >> 16);
#else
    uint word = words[place];
    return vec4(word & 0xffu, (word >> 8) & 0xffu, (word >> 16) & 0xffu, word >> 24);
#endif
}

#if CLUSTERED
vec3 relight(uint receiver) {
    vec4 weights = readNumbers(0u, receiver);
    uint first = firstProducts[uint(weights.x)];
    weights.x = 1.0;  // of R_k0
    vec3 sum = vec3(0.0);
    for (uint panel = 0u; panel < panelCount; ++panel) {
        if (panel > 0u) weights = readNumbers(panel, receiver);
        uint p = first + 4u * panel;  // weights are 0 beyond those of the cluster
        sum += weights.x * products[p].rgb + weights.y * products[p + 1u].rgb +
               weights.z * products[p + 2u].rgb + weights.w * products[p + 3u].rgb;
    }
    return sum;
}
#else
vec3 relight(uint receiver) {
    vec3 sum = biasRadiance;
    for (uint panel = 0u; panel < panelCount; ++panel)
        sum += readNumbers(panel, receiver) * light[panel];
    return sum;
}
#endif
#endif

void main() {
#if RELIT
    radiancePerBaseColor = relitVertices[gl_VertexID].perBaseColor.rgb;
    constantRadiance = relitVertices[gl_VertexID].constant.rgb;
#else
    radiancePerBaseColor = relight(receiverOfVertex[gl_VertexID]);
    constantRadiance = vec3(0.0);
#endif
#ifdef MIRRORED
    mirrorVisibility = relitVertices[gl_VertexID].perBaseColor.a;
    surfaceNormal = normal;
    towardsEye = eye - position;
#endif
    uvs = uvSets;
    vertexColor = color;
    gl_Position = clipFromEyeSpace * vec4(position - eye, 1.0);
}
