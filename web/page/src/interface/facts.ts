import { type Layer, type Relightable, bytesPerNumber } from 'openprt-three';

import { chooseShown } from '../picture/pane.js';
import type { Side } from '../view_state.js';

const kEncodings = { float32: 'floats', unorm16: '16 bits', unorm8: '8 bits' };

/** What an asset stores of the transport that is shown, in a line. */
export function describeAsset(relightable: Relightable, side: Side): string {
    const { asset, bandCount } = relightable;
    const { transport } = chooseShown(relightable, side);
    const layer = asset.header.layers.find((candidate) => candidate.transport === transport);
    return [
        `${asset.header.vertexCount.toLocaleString('en')} vertices`,
        ...(layer ? [`${layer.numberCount * bytesPerNumber(layer.storage.encoding)} bytes a vertex`, describeStorage(layer)] : ['from normals alone']),
        `${bandCount} bands`,
    ]
        .map((fact) => fact.replaceAll(' ', '\u00a0')) // lines break between facts
        .join(' · ');
}

function describeStorage({ clusters, storage }: Layer): string {
    const encoding = kEncodings[storage.encoding];
    return clusters ? `${clusters.componentCounts.length} clusters, ${encoding}` : encoding;
}
