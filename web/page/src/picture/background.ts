// Bibliography
//   [Sigg05]  Fast third-order texture filtering
import { BufferAttribute, BufferGeometry, type DataTexture, Matrix3, Matrix4, Mesh, type PerspectiveCamera, Scene, ShaderMaterial } from 'three';
import type { Mat3 } from 'openprt-three';

import { type LightPicture, makePictureTexture } from '../lights/light_picture.js';

const kVertexShader = `
uniform mat4 worldFromClip;
varying vec3 direction;
void main() {
    gl_Position = vec4(position.xy, 1.0, 1.0);
    vec4 far = worldFromClip * gl_Position;
    direction = far.xyz / far.w - cameraPosition;
}`;

const kFragmentShader = `
uniform sampler2D picture;
uniform mat3 lightFromWorld;
varying vec3 direction;

// A uniform cubic B-spline over the texels, by four linear samples [Sigg05]: a small picture is seen as a blur, not as squares.
vec3 blurAt(vec2 uv) {
    vec2 size = vec2(textureSize(picture, 0));
    vec2 place = uv * size - 0.5;
    vec2 f = fract(place);
    vec2 g = 1.0 - f;
    vec2 w0 = g * g * g / 6.0;
    vec2 w1 = (4.0 - 6.0 * f * f + 3.0 * f * f * f) / 6.0;
    vec2 w3 = f * f * f / 6.0;
    vec2 w2 = 1.0 - w0 - w1 - w3;
    vec2 near = w0 + w1;
    vec2 low = (floor(place) - 0.5 + w1 / near) / size;
    vec2 high = (floor(place) + 1.5 + w3 / (w2 + w3)) / size;
    vec3 top = mix(textureLod(picture, vec2(high.x, low.y), 0.0).rgb, textureLod(picture, low, 0.0).rgb, near.x);
    vec3 bottom = mix(textureLod(picture, high, 0.0).rgb, textureLod(picture, vec2(low.x, high.y), 0.0).rgb, near.x);
    return mix(bottom, top, near.y);
}

void main() {
    vec3 d = normalize(lightFromWorld * direction);
    vec2 uv = vec2(0.5 + atan(d.z, d.x) / 6.2831853071795865, acos(clamp(d.y, -1.0, 1.0)) / 3.1415926535897932);
    gl_FragColor = vec4(blurAt(uv), 1.0);
    #include <tonemapping_fragment>
    #include <colorspace_fragment>
}`;

/** The light behind everything, from its small picture. */
export class Background {
    readonly scene = new Scene();
    private readonly uniforms = {
        picture: { value: null as DataTexture | null },
        lightFromWorld: { value: new Matrix3() },
        worldFromClip: { value: new Matrix4() },
    };
    private shown?: LightPicture;

    constructor() {
        const triangle = new BufferGeometry();
        triangle.setAttribute('position', new BufferAttribute(new Float32Array([-1, -1, 0, 3, -1, 0, -1, 3, 0]), 3));
        const { uniforms } = this;
        const material = new ShaderMaterial({ vertexShader: kVertexShader, fragmentShader: kFragmentShader, uniforms, depthTest: false, depthWrite: false });
        const mesh = new Mesh(triangle, material);
        mesh.frustumCulled = false;
        this.scene.add(mesh);
    }

    /** @param worldFromLight  how the light is turned */
    set(picture: LightPicture, worldFromLight: Mat3): void {
        // Written column after column, rows become columns: of a rotation, its inverse.
        this.uniforms.lightFromWorld.value.fromArray([...worldFromLight]);
        if (picture === this.shown) return;
        this.shown = picture;
        this.uniforms.picture.value?.dispose();
        this.uniforms.picture.value = makePictureTexture(picture);
    }

    look({ projectionMatrixInverse, matrixWorld }: PerspectiveCamera): void {
        this.uniforms.worldFromClip.value.multiplyMatrices(matrixWorld, projectionMatrixInverse);
    }
}
