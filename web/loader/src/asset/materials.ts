import type { GltfDocument } from './gltf_document.js';
import type { JsonCursor } from './json_cursor.js';

/** Demands materials that make sense as far as relighting uses them, so that no loader stumbles over them; and names that are texts. */
export function checkMaterials(document: GltfDocument): void {
    const materials = document.list('materials');
    const textures = document.list('textures');
    const images = document.list('images');
    const requireIndex = (reference: JsonCursor | undefined, list: readonly JsonCursor[], what: string): void => {
        if (reference && !(reference.toCount() < list.length)) reference.reject(`is no ${what}`);
    };
    for (const key of ['nodes', 'meshes', 'materials']) document.list(key).forEach((object) => object.find('name')?.toText());
    for (const mesh of document.list('meshes'))
        for (const primitive of mesh.at('primitives').elements()) requireIndex(primitive.find('material'), materials, 'material');
    for (const material of materials) {
        const surface = material.find('pbrMetallicRoughness');
        requireIndex(surface?.find('baseColorTexture')?.at('index'), textures, 'texture');
        const factor = surface?.find('baseColorFactor');
        if (factor && factor.elements().map((number) => number.toNumber()).length !== 4) factor.reject('must be four numbers');
        for (const key of ['metallicFactor', 'roughnessFactor']) surface?.find(key)?.toNumber();
        material.find('alphaCutoff')?.toNumber();
    }
    for (const texture of textures) requireIndex(texture.find('source'), images, 'image');
    for (const image of images) requireIndex(image.find('bufferView'), document.list('bufferViews'), 'buffer view');
}
