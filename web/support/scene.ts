import { writeFileSync } from 'node:fs';
import { join } from 'node:path';

/** Four corners, against the clock as seen from outside. */
type Quad = [Point, Point, Point, Point];
type Point = [number, number, number];

interface Part {
    quads: Quad[];
    material: object;
}

const kFloor: Quad[] = [[[-2, 0, 2], [2, 0, 2], [2, 0, -2], [-2, 0, -2]]];
const kWall: Quad[] = [[[-2, 0, -2], [2, 0, -2], [2, 1.5, -2], [-2, 1.5, -2]]];
const kBlock: Quad[] = [
    [[-0.6, 0.9, 0.5], [0.4, 0.9, 0.5], [0.4, 0.9, -0.3], [-0.6, 0.9, -0.3]],
    [[-0.6, 0, 0.5], [0.4, 0, 0.5], [0.4, 0.9, 0.5], [-0.6, 0.9, 0.5]],
    [[0.4, 0, 0.5], [0.4, 0, -0.3], [0.4, 0.9, -0.3], [0.4, 0.9, 0.5]],
    [[-0.6, 0, -0.3], [-0.6, 0, 0.5], [-0.6, 0.9, 0.5], [-0.6, 0.9, -0.3]],
    [[0.4, 0, -0.3], [-0.6, 0, -0.3], [-0.6, 0.9, -0.3], [0.4, 0.9, -0.3]],
];

function dye(red: number, green: number, blue: number, more: object = {}): object {
    return { pbrMetallicRoughness: { baseColorFactor: [red, green, blue, 1], metallicFactor: 0, roughnessFactor: 1, ...more } };
}

/** Writes a block on a floor before a red wall, as block.gltf; and with a texture on the floor, or a block of metal. */
export function writeBlocks(folder: string, texture: string): void {
    const parts = (floor: object, block: object): Part[] => [
        { quads: kFloor, material: floor },
        { quads: kWall, material: dye(0.7, 0.1, 0.1) },
        { quads: kBlock, material: block },
    ];
    const [gray, white] = [dye(0.6, 0.6, 0.6), dye(0.8, 0.8, 0.7)];
    writeGltf(join(folder, 'block.gltf'), parts(gray, white), texture);
    writeGltf(join(folder, 'textured.gltf'), parts(dye(1, 1, 1, { baseColorTexture: { index: 0 } }), white), texture);
    writeGltf(join(folder, 'metal.gltf'), parts(gray, dye(0.9, 0.7, 0.4, { metallicFactor: 1, roughnessFactor: 1 })), texture);
}

function writeGltf(path: string, parts: readonly Part[], texture: string): void {
    const numbers = parts.flatMap(({ quads }) => [quads.flat(2), quads.flatMap(() => [0, 1, 1, 1, 1, 0, 0, 0])]);
    const floats = Float32Array.from(numbers.flat());
    let byteOffset = 0;
    const views = numbers.map(({ length }) => {
        byteOffset += 4 * length;
        return { buffer: 0, byteOffset: byteOffset - 4 * length, byteLength: 4 * length };
    });
    const indices = Uint16Array.from({ length: 6 * Math.max(...parts.map(({ quads }) => quads.length)) }, (_, i) => 4 * Math.floor(i / 6) + [0, 1, 2, 0, 2, 3][i % 6]);
    const bytes = Buffer.concat([Buffer.from(floats.buffer), Buffer.from(indices.buffer)]);
    writeFileSync(path, JSON.stringify({
        asset: { version: '2.0' },
        scene: 0,
        scenes: [{ nodes: parts.map((_, i) => i) }],
        nodes: parts.map((_, i) => ({ mesh: i })),
        meshes: parts.map((_, i) => ({ primitives: [{ attributes: { POSITION: 3 * i, TEXCOORD_0: 3 * i + 1 }, indices: 3 * i + 2, material: i }] })),
        materials: parts.map(({ material }) => material),
        images: [{ uri: texture }],
        textures: [{ source: 0 }],
        accessors: parts.flatMap(({ quads }, i) => [
            { bufferView: 2 * i, componentType: 5126, count: 4 * quads.length, type: 'VEC3', ...boundsOf(quads.flat()) },
            { bufferView: 2 * i + 1, componentType: 5126, count: 4 * quads.length, type: 'VEC2' },
            { bufferView: views.length, componentType: 5123, count: 6 * quads.length, type: 'SCALAR' },
        ]),
        bufferViews: [...views, { buffer: 0, byteOffset, byteLength: indices.byteLength }],
        buffers: [{ uri: `data:application/octet-stream;base64,${bytes.toString('base64')}`, byteLength: bytes.length }],
    }));
}

function boundsOf(points: readonly Point[]): object {
    const over = (pick: (...values: number[]) => number): number[] => [0, 1, 2].map((axis) => pick(...points.map((point) => point[axis])));
    return { min: over(Math.min), max: over(Math.max) };
}
