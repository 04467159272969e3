#version 430 core
// What a light sends to each receiver, from all directions, in the receiver's frame:
//
//   l_i = Σ_j M_ij L_j                  of matrices                        [Sloan02, 5]
//   l   = R_k0 + Σ_p w_p R_kp           of clusters, R = M L               [Sloan03]
//
// STORED_BYTES       of a number: 4 is a float, 2 and 1 are integers as they stand
// CLUSTERED          1: a row is its cluster k and weights w_p; 0: a matrix, [channel][i][j]
// CHANNEL_COUNT      of matrices: 1 or 3
// COEFFICIENT_COUNT  of incident radiance, of one colour

layout(local_size_x = 64) in;  // receivers; y counts what is computed of each

layout(location = 2) uniform uint receiverCount;
layout(location = 3) uniform uint panelCount;

// Numbers of all receivers in panels of four columns: [panel][receiver][4].
layout(std430, binding = 0) readonly buffer Transfer { uint words[]; };

#if CLUSTERED
layout(std430, binding = 1) readonly buffer FirstProducts { uint firstProducts[]; };  // of k
layout(std430, binding = 2) readonly buffer Products { float products[]; };  // [k, p][colour][place, padded]
layout(location = 4) uniform uint paddedCount;  // of places
#else
struct Row {
    vec3 bias;   // Σ_j of the columns' biases and the light
    uint place;  // of l_i among a receiver's
};
layout(std430, binding = 1) readonly buffer Rows { Row rows[]; };  // of all channels, and one more
layout(std430, binding = 2) readonly buffer Light { mat3x4 light[]; };  // a column a colour, for the numbers of a panel
layout(location = 4) uniform uint columnCount;  // of a matrix
layout(location = 5) uniform uint rowCount;     // of all channels
#endif

layout(std430, binding = 3) writeonly buffer Incident { float incident[]; };  // [colour, place][receiver]

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

void write(uint place, vec3 colors, uint receiver) {
    for (uint c = 0u; c < 3u; ++c)
        incident[(c * COEFFICIENT_COUNT + place) * receiverCount + receiver] = colors[c];
}

#if CLUSTERED
// A place of all colours.
void receive(uint receiver, uint place) {
    vec4 weights = readNumbers(0u, receiver);
    uint first = firstProducts[uint(weights.x)];
    weights.x = 1.0;  // of R_k0
    vec3 sum = vec3(0.0);
    for (uint panel = 0u; panel < panelCount; ++panel) {
        if (panel > 0u) weights = readNumbers(panel, receiver);
        for (uint k = 0u; k < 4u; ++k) {  // weights are 0 beyond those of the cluster
            uint at = (first + 4u * panel + k) * 3u * paddedCount + place;
            sum += weights[k] * vec3(products[at], products[at + paddedCount], products[at + 2u * paddedCount]);
        }
    }
    write(place, sum, receiver);
}
#else
void writeRow(uint row, vec3 sum, uint receiver) {
#if CHANNEL_COUNT == 3
    // The light of a row has one colour.
    incident[rows[row].place * receiverCount + receiver] = sum.r + sum.g + sum.b;
#else
    write(rows[row].place, sum, receiver);
#endif
}

// Four rows, which begin with a panel.
void receive(uint receiver, uint group) {
    uint row = 4u * group;
    uint column = 0u;
    vec3 sum = rows[row].bias;
    uint end = min((group + 1u) * columnCount, panelCount);
    for (uint panel = group * columnCount; panel < end; ++panel) {
        vec4 numbers = readNumbers(panel, receiver);
        for (uint k = 0u; k < 4u; ++k) {
            sum += numbers[k] * vec3(light[panel][0][k], light[panel][1][k], light[panel][2][k]);
            if (++column < columnCount || row == rowCount) continue;
            writeRow(row, sum, receiver);
            sum = rows[++row].bias;
            column = 0u;
        }
    }
}
#endif

void main() {
    if (gl_GlobalInvocationID.x < receiverCount) receive(gl_GlobalInvocationID.x, gl_GlobalInvocationID.y);
}
