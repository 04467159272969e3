import { readLightFile } from '../lights/light_file.js';
import type { Viewer } from '../viewer.js';
import { make } from './controls.js';
import { type Messages, sentenceOf } from './messages.js';

const kAsset = /\.glb$/i;
const kLight = /\.(hdr|exr|json)$/i;

/** Shows files of the user's: by a button, or dropped on the page. */
export class FileDrop {
    private readonly input = make('input', { id: 'files', type: 'file', multiple: true, accept: '.glb,.hdr,.exr,.json', hidden: true });

    constructor(private readonly viewer: Viewer, private readonly messages: Messages) {
        this.input.addEventListener('change', () => {
            void this.open([...(this.input.files ?? [])]).then(() => (this.input.value = ''));
        });
        document.body.append(this.input);
        window.addEventListener('dragover', (event) => {
            event.preventDefault();
            document.body.classList.add('dropping');
        });
        window.addEventListener('dragleave', (event) => {
            if (!event.relatedTarget) document.body.classList.remove('dropping');
        });
        window.addEventListener('drop', (event) => {
            event.preventDefault();
            document.body.classList.remove('dropping');
            void this.open([...(event.dataTransfer?.files ?? [])]);
        });
    }

    ask(): void {
        this.input.click();
    }

    /** Shows them; of one that is wrong it says why, and what was shown stays. */
    private async open(files: readonly File[]): Promise<void> {
        if (files.length > 0) this.messages.clear();
        for (const file of files) {
            try {
                await this.show(file);
            } catch (error) {
                this.messages.say(sentenceOf(file.name, error));
            }
        }
    }

    private async show(file: File): Promise<void> {
        const { viewer } = this;
        if (kAsset.test(file.name)) {
            const asset = await viewer.shelf.addFile(file.name.replace(/(\.prt)?\.glb$/i, ''), new Uint8Array(await file.arrayBuffer()));
            viewer.changeSide('first', { asset });
        } else if (kLight.test(file.name)) {
            viewer.lights.push(readLightFile(file.name, await file.arrayBuffer()));
            viewer.change({ light: viewer.lights.length - 1 });
        } else {
            throw new Error('it is none of .glb, .hdr, .exr and .json');
        }
    }
}
