import { writeBlocks } from '../../../support/scene.js';
import type { PrtFolder } from './prt_folder.js';

/** The assets of page.html, each `<name>.prt.glb`, and its lights. */
export const kAssets = ['block', 'clusters', 'textured', 'metal'] as const;
export const kLights = ['sky.json', 'sun.json', 'uniform:0.5', 'sky.exr'] as const;

/** Bakes a block before a wall, stored in one form or another. */
export function makePage(folder: PrtFolder): void {
    makeBlock(folder);
    folder.run('bake textured.gltf -o textured.prt.glb --method u16 --bands 4 --samples 64 --max-edge 0.2');
    folder.run('bake metal.gltf -o metal.prt.glb --method u8 --transport glossy --bands 3 --incident-bands 3 --samples 64 --bounces 1 --max-edge 0.3');
    folder.run('compress block.prt.glb -o clusters.prt.glb --method cpca --clusters 8 --components 7 --meshopt');
    folder.write('sky.json', folder.run('light sky:60,40 uniform:0.5 --scale 0.06 --bands 4 --format json'));
    folder.write('sun.json', folder.run('light sun:60,40,20 uniform:0.2 --bands 4 --format json'));
    folder.write('sun-auto.json', folder.run('light sun.json --window auto --nonnegative irradiance --bands 4 --format json'));
    for (const bands of [2, 3]) folder.write(`sky-${bands}.json`, folder.run(`light sky.json --bands ${bands} --format json`));
    const assets = kAssets.map((name) => `${name}.prt.glb`).join(' ');
    folder.run(`web ${assets} ${kLights.map((light) => `--light ${light}`).join(' ')} -o page.html`);
}

/** The first of them alone. */
export function makeBlock(folder: PrtFolder): void {
    folder.run('light sky:60,40 uniform:2 --scale 0.06 --environment sky.exr --size 32');
    folder.run('light sky:60,40 uniform:2 --scale 0.06 --environment floor.png --size 64');
    writeBlocks(folder.of('.'), 'floor.png');
    folder.run('bake block.gltf -o block.prt.glb --bands 4 --samples 64 --max-edge 0.2');
}
