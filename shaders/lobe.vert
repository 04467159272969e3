#version 430 core
// Places the surface of a lobe in the picture.

layout(location = 0) in vec3 position;  // the farthest from the origin is at 1
layout(location = 1) in vec3 normal;
layout(location = 2) in vec4 colorAndValue;

layout(location = 0) uniform mat4 clipFromEyeSpace;  // of the lobe's axes and unit of length, origin at the eye
layout(location = 1) uniform vec3 eye;
layout(location = 2) uniform mat3 cameraFromLobe;

centroid out vec3 cameraNormal;
centroid out vec4 colorOfValue;
centroid out float distanceAhead;
flat out float cornerAhead;

void main() {
    cameraNormal = cameraFromLobe * normal;
    colorOfValue = colorAndValue;
    gl_Position = clipFromEyeSpace * vec4(position - eye, 1.0);
    distanceAhead = gl_Position.w;
    cornerAhead = gl_Position.w;
}
