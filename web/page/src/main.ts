import { readPageData } from './page_data.js';

document.title = readPageData().assets.map(({ name }) => name).join(', ') || document.title;
