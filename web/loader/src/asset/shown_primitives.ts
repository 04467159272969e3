import type { GltfDocument } from './gltf_document.js';
import { JsonCursor } from './json_cursor.js';

/** A primitive that the scene shows. */
export interface ShownPrimitive {
    /** Index of its mesh in the glTF, and its own in the mesh. */
    mesh: number;
    primitive: number;
    object: JsonCursor;
}

type Matrix = readonly number[]; // 4×4, columns one after the other, as glTF has them

const kIdentity: Matrix = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];

/** The primitives that the scene shows, in the order of its nodes. Each must stand there once, and where it was baked. */
export function listShownPrimitives(document: GltfDocument): ShownPrimitive[] {
    const nodes = document.list('nodes');
    const meshes = document.list('meshes');
    const shown: ShownPrimitive[] = [];
    const visitedNodes = new Set<number>();
    const shownMeshes = new Set<number>();

    const pending = rootsOf(document).map((node) => ({ node, world: kIdentity }));
    pending.reverse();
    for (let next = pending.pop(); next; next = pending.pop()) {
        const index = next.node.toCount();
        const node = nodes[index] ?? next.node.reject('is no node');
        if (visitedNodes.has(index)) next.node.reject('is a node that has a parent already');
        visitedNodes.add(index);

        const world = multiply(next.world, matrixOf(node));
        const mesh = node.find('mesh');
        if (mesh) {
            const meshIndex = mesh.toCount();
            const object = meshes[meshIndex] ?? mesh.reject('is no mesh');
            if (shownMeshes.has(meshIndex)) mesh.reject('is shown twice, and each place has light of its own');
            shownMeshes.add(meshIndex);
            if (world.some((entry, i) => entry !== kIdentity[i])) object.reject('is moved by its node, away from where it was baked');
            object.at('primitives').elements().forEach((primitive, i) => shown.push({ mesh: meshIndex, primitive: i, object: primitive }));
        }
        const children = node.find('children')?.elements() ?? [];
        for (const child of children.reverse()) pending.push({ node: child, world });
    }
    return shown;
}

/** The nodes of the scene that the file names; where it names none, all that have no parent. */
function rootsOf(document: GltfDocument): JsonCursor[] {
    const reference = document.root.find('scene');
    if (reference) {
        const scene = document.list('scenes')[reference.toCount()] ?? reference.reject('is no scene');
        return scene.find('nodes')?.elements() ?? [];
    }
    const nodes = document.list('nodes');
    const children = new Set(nodes.flatMap((node) => node.find('children')?.elements() ?? []).map((child) => child.toCount()));
    return [...nodes.keys()].filter((node) => !children.has(node)).map((node) => new JsonCursor(node, `glTF.nodes[${node}]`));
}

function numbersOf(node: JsonCursor, key: string, fallback: readonly number[]): readonly number[] {
    const member = node.find(key);
    if (!member) return fallback;
    const numbers = member.elements().map((number) => number.toNumber());
    if (numbers.length !== fallback.length) member.reject(`must have ${fallback.length} numbers`);
    return numbers;
}

/** parentFromNode. */
function matrixOf(node: JsonCursor): Matrix {
    if (node.find('matrix')) return numbersOf(node, 'matrix', kIdentity);
    const [tx, ty, tz] = numbersOf(node, 'translation', [0, 0, 0]);
    const [x, y, z, w] = numbersOf(node, 'rotation', [0, 0, 0, 1]);
    const [sx, sy, sz] = numbersOf(node, 'scale', [1, 1, 1]);
    return [
        sx * (1 - 2 * (y * y + z * z)), sx * 2 * (x * y + z * w), sx * 2 * (x * z - y * w), 0,
        sy * 2 * (x * y - z * w), sy * (1 - 2 * (x * x + z * z)), sy * 2 * (y * z + x * w), 0,
        sz * 2 * (x * z + y * w), sz * 2 * (y * z - x * w), sz * (1 - 2 * (x * x + y * y)), 0,
        tx, ty, tz, 1,
    ];
}

function multiply(a: Matrix, b: Matrix): Matrix {
    return kIdentity.map((_, i) => {
        let sum = 0;
        for (let k = 0; k < 4; ++k) sum += a[4 * k + (i % 4)] * b[4 * Math.floor(i / 4) + k];
        return sum;
    });
}
