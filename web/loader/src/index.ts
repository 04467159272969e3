export { OpenPrtError, type ErrorCode } from './error.js';
export { type Header, type Provenance, kExtension } from './asset/header.js';
export { type Clusters, type Encoding, type Layer, type Storage, type StoredArray, type Transport, kTransports } from './asset/layer.js';
export { type Asset, type AssetPrimitive, type ReadOptions, findLayer, isAsset, readAsset, readAssetParts } from './asset/read_asset.js';
export { type MeshoptDecoder } from './asset/gltf_document.js';
export { coefficientsOf } from './relight/coefficients.js';
