export { OpenPrtError, type ErrorCode } from './error.js';
export { type Header, type Provenance, kExtension } from './asset/header.js';
export { type Clusters, type Encoding, type Layer, type Storage, type StoredArray, type Transport, bytesPerNumber, kTransports } from './asset/layer.js';
export { type Asset, type AssetPrimitive, type ReadOptions, findLayer, isAsset, readAsset, readAssetParts } from './asset/read_asset.js';
export { type MeshoptDecoder } from './asset/gltf_document.js';
export { coefficientsOf } from './relight/coefficients.js';
export { type Mat3, type Vec3, rotationXyz, tangentFrame, transform, transpose } from './math.js';
export { discLighting, sunDirection, sunLighting, uniformLighting } from './sh/analytic_lights.js';
export { type NonNegative, clampedCosineFactors, deringingFactors } from './sh/deringing.js';
export {
    type Lighting, addLighting, applyWindow, darkness, parseLighting, reconstruct, scaleLighting, toThreeProbe, withBands,
} from './sh/lighting.js';
export { type LatLongImage, projectLatLong } from './sh/project_lat_long.js';
export { projectTexture } from './sh/project_texture.js';
export { rotateLighting } from './sh/rotate.js';
export { evaluateSh, shIndex } from './sh/sh.js';
export { type ShWindow, windowFactors } from './sh/window.js';
export { receiveLight, relight } from './relight/relight.js';
export { OpenPrtPlugin, relightableOf } from './plugin.js';
export { Relightable, type RelightOptions } from './relightable.js';
export { makeLobeTable } from './relight/gltf_lobes.js';
export { type ExitRadiance, reflect } from './relight/reflect.js';
