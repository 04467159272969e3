#version 430 core
// One triangle that covers the viewport, behind all else.

out vec2 place;  // (0, 0) is the lower left corner, (1, 1) the upper right

void main() {
    place = vec2(gl_VertexID == 1 ? 2.0 : 0.0, gl_VertexID == 2 ? 2.0 : 0.0);
    gl_Position = vec4(2.0 * place - 1.0, 1.0, 1.0);
}
