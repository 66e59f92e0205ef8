// The viewer of pictures: a row's picture against the truth, by wipe, blink, difference or FLIP
// map. Without this script the pictures stand below the plots.
'use strict';

const openViewer = (() => {
    const measurements = JSON.parse(document.getElementById('measurements').textContent);
    const calm = matchMedia('(prefers-reduced-motion: reduce)');
    const modes = ['wipe', 'blink', 'difference', 'FLIP map'];

    const dialog = document.createElement('dialog');
    dialog.setAttribute('aria-labelledby', 'viewer-title');
    dialog.innerHTML = `
        <div class="viewer-head">
            <h2 id="viewer-title"></h2>
            <button type="button" data-do="close">Close</button>
        </div>
        <div class="viewer-tools">
            <span class="modes" role="group" aria-label="How to compare"></span>
            <label data-for="blink">blinks per second
                <input type="range" name="rate" min="0.5" max="8" step="0.5" value="2">
                <output></output></label>
            <label data-for="difference">gain
                <input type="range" name="gain" min="0" max="6" step="1" value="3">
                <output></output></label>
            <label>zoom
                <input type="range" name="zoom" min="1" max="8" step="1" value="3">
                <output></output></label>
            <span>
                <button type="button" data-do="previous">Previous</button>
                <button type="button" data-do="next">Next</button>
            </span>
            <button type="button" data-do="part"></button>
        </div>
        <div class="stage" tabindex="0" role="group" aria-label="Picture">
            <div class="stage-inner">
                <canvas role="img"></canvas>
                <div class="wipe" role="slider" tabindex="0" aria-valuemin="0" aria-valuemax="100"
                    aria-label="Wipe between the truth and the picture"></div>
                <span class="tag left"></span><span class="tag right"></span>
            </div>
        </div>
        <p class="viewer-text"></p>
        <p class="note"><kbd>&larr;</kbd> <kbd>&rarr;</kbd> move the wipe, <kbd>W</kbd> wipe,
            <kbd>B</kbd> blink, <kbd>D</kbd> difference, <kbd>F</kbd> FLIP map,
            <kbd>+</kbd> <kbd>&minus;</kbd> zoom, <kbd>P</kbd> <kbd>N</kbd> previous and next
            picture, <kbd>Esc</kbd> close</p>`;
    for (const mode of modes) {
        const button = document.createElement('button');
        button.type = 'button';
        button.dataset.mode = mode;
        button.textContent = mode;
        dialog.querySelector('.modes').append(button);
    }
    document.body.append(dialog);

    const $ = (selector) => dialog.querySelector(selector);
    const canvas = $('canvas');
    const context = canvas.getContext('2d', { willReadFrequently: true });
    const wipe = $('.wipe');
    const inner = $('.stage-inner');

    // `part` is 'crop' or 'frame'; `shows` tells whether blinking shows the picture or the truth.
    const state = {
        row: -1, set: '', part: 'crop', mode: 'wipe', wipe: 0.5, shows: true, opener: null,
    };
    let timer = 0;

    // --- the pictures in the page -----------------------------------------------------------

    const figureOf = (set, row) =>
        document.querySelector(`figure[data-set="${set}"][data-row="${row}"]`);
    const figure = () => figureOf(state.set, state.row);
    const truthFigure = () => document.querySelector(`figure[data-set="${state.set}"].truth`);
    const imageOf = (from, part) => from?.querySelector(`img[data-part="${part}"]`) ?? null;

    // Returns the picture, the truth and the FLIP map of the part that is shown: a crop, or the
    // whole frame. The map is null if the page has none.
    function images() {
        return {
            picture: imageOf(figure(), state.part),
            truth: imageOf(truthFigure(), state.part),
            map: state.part === 'crop' ? imageOf(figure(), 'map') : null,
        };
    }

    // Chooses the part that the row has, preferably the one that is shown already.
    function choosePart() {
        const has = (part) => imageOf(figure(), part) && imageOf(truthFigure(), part);
        const other = state.part === 'crop' ? 'frame' : 'crop';
        if (!has(state.part) && has(other)) {
            state.part = other;
        }
        $('[data-do="part"]').hidden = !has(other);
        $('[data-do="part"]').textContent = other === 'frame' ? 'Whole frame' : 'Crop';
    }

    // --- drawing ----------------------------------------------------------------------------

    function pixelsOf(image, width, height) {
        context.drawImage(image, 0, 0);
        return context.getImageData(0, 0, width, height);
    }

    function drawDifference(truth, picture, gain) {
        const { width, height } = canvas;
        const a = pixelsOf(truth, width, height);
        const b = pixelsOf(picture, width, height);
        for (let i = 0; i < a.data.length; i++) {
            a.data[i] = i % 4 === 3 ? 255 : gain * Math.abs(a.data[i] - b.data[i]);
        }
        context.putImageData(a, 0, 0);
    }

    function drawWipe(truth, picture) {
        const { width, height } = canvas;
        const left = Math.round(state.wipe * width);
        context.drawImage(picture, 0, 0);
        if (left > 0) {
            context.drawImage(truth, 0, 0, left, height, 0, 0, left, height);
        }
    }

    function draw() {
        const { truth, picture, map } = images();
        if (!truth || !picture) {
            return;
        }
        const zoom = Number($('[name="zoom"]').value);
        canvas.width = picture.naturalWidth;
        canvas.height = picture.naturalHeight;
        canvas.style.width = `${zoom * canvas.width}px`;
        canvas.style.height = `${zoom * canvas.height}px`;
        if (state.mode === 'wipe') {
            drawWipe(truth, picture);
        } else if (state.mode === 'blink') {
            context.drawImage(state.shows ? picture : truth, 0, 0);
        } else if (state.mode === 'difference') {
            drawDifference(truth, picture, 2 ** $('[name="gain"]').value);
        } else {
            context.drawImage(map ?? picture, 0, 0);
        }
        wipe.style.left = `${100 * state.wipe}%`;
        wipe.setAttribute('aria-valuenow', Math.round(100 * state.wipe));
        drawTags();
    }

    function drawTags() {
        const name = measurements[state.row].settings;
        const tags = {
            wipe: ['truth', name],
            blink: [state.shows ? name : 'truth', ''],
            difference: [`difference, ${2 ** $('[name="gain"]').value} times`, ''],
            'FLIP map': ['FLIP map', ''],
        }[state.mode];
        ['.tag.left', '.tag.right'].forEach((tag, i) => {
            $(tag).textContent = tags[i];
            $(tag).hidden = !tags[i];
        });
        canvas.setAttribute('aria-label', tags.filter(Boolean).join(' and '));
    }

    // --- the state --------------------------------------------------------------------------

    function restartBlinking() {
        clearInterval(timer);
        if (dialog.open && state.mode === 'blink' && !calm.matches) {
            timer = setInterval(() => {
                state.shows = !state.shows;
                draw();
            }, 500 / $('[name="rate"]').value);
        }
    }

    // Shows the state in the controls and in the picture.
    function update() {
        choosePart();
        const m = measurements[state.row];
        const { map } = images();
        if (state.mode === 'FLIP map' && !map) {
            state.mode = 'wipe';
        }
        $('#viewer-title').textContent = m.settings;
        const { where, corner } = figure().dataset;
        const place = state.part === 'crop' ? `${where}; ${corner}.` : `${where}; whole frame.`;
        $('.viewer-text').textContent = [place, m.time, m.errors].filter(Boolean).join('\n');
        for (const button of dialog.querySelectorAll('[data-mode]')) {
            button.setAttribute('aria-pressed', button.dataset.mode === state.mode);
            button.hidden = button.dataset.mode === 'FLIP map' && !map;
        }
        for (const label of dialog.querySelectorAll('[data-for]')) {
            label.hidden = label.dataset.for !== state.mode;
        }
        if (calm.matches) {
            $('[data-for="blink"]').hidden = true;
        }
        $('[name="rate"] + output').textContent = $('[name="rate"]').value;
        $('[name="gain"] + output').textContent = 2 ** $('[name="gain"]').value;
        $('[name="zoom"] + output').textContent = `${$('[name="zoom"]').value}x`;
        if (state.mode !== 'wipe' && document.activeElement === wipe) {
            $('.stage').focus(); // Otherwise the dialog would lose the focus with the wipe.
        }
        wipe.hidden = state.mode !== 'wipe';
        inner.classList.toggle('wipes', state.mode === 'wipe');
        draw();
        restartBlinking();
    }

    function setMode(mode) {
        if (mode === 'blink' && state.mode === 'blink') {
            state.shows = !state.shows;
        }
        state.mode = mode;
        update();
    }

    function moveWipe(to) {
        state.wipe = Math.min(1, Math.max(0, to));
        draw();
    }

    function setZoom(zoom) {
        $('[name="zoom"]').value = zoom;
        update();
    }

    // The greatest zoom up to 4 at which the whole picture fits into the stage.
    function fitZoom() {
        const { picture } = images();
        const room = $('.stage').clientWidth || innerWidth;
        setZoom(Math.max(1, Math.min(4, Math.floor(room / picture.naturalWidth),
            Math.floor((0.62 * innerHeight) / picture.naturalHeight))));
    }

    function step(by) {
        const figures = document.querySelectorAll(`figure[data-set="${state.set}"][data-row]`);
        const rows = [...figures].map((other) => Number(other.dataset.row));
        const next = rows.indexOf(state.row) + by;
        state.row = rows[(next + rows.length) % rows.length];
        update();
    }

    function changePart() {
        state.part = state.part === 'crop' ? 'frame' : 'crop';
        update();
        fitZoom();
    }

    // --- events -----------------------------------------------------------------------------

    const actions = {
        close: () => dialog.close(),
        previous: () => step(-1),
        next: () => step(1),
        part: changePart,
    };

    function isInside(event, box) {
        return event.clientX >= box.left && event.clientX <= box.right &&
            event.clientY >= box.top && event.clientY <= box.bottom;
    }

    dialog.addEventListener('click', (event) => {
        const button = event.target.closest('button');
        if (button?.dataset.mode) {
            setMode(button.dataset.mode);
        } else if (button) {
            actions[button.dataset.do]();
        } else if (event.target === dialog && !isInside(event, dialog.getBoundingClientRect())) {
            dialog.close();
        }
    });
    dialog.addEventListener('input', update);
    dialog.addEventListener('close', () => {
        clearInterval(timer);
        state.opener?.focus();
    });
    dialog.addEventListener('keydown', (event) => {
        const zoom = Number($('[name="zoom"]').value);
        const keys = {
            w: () => setMode('wipe'),
            b: () => setMode('blink'),
            d: () => setMode('difference'),
            f: () => images().map && setMode('FLIP map'),
            n: () => step(1),
            p: () => step(-1),
            '+': () => setZoom(zoom + 1),
            '=': () => setZoom(zoom + 1),
            '-': () => setZoom(zoom - 1),
        };
        const moves = { ArrowLeft: -0.02, ArrowRight: 0.02, Home: -1, End: 1 };
        const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
        if (event.ctrlKey || event.altKey || event.metaKey) {
            return;
        }
        if (key in keys) {
            keys[key]();
        } else if (key >= '1' && key <= '8') {
            setZoom(Number(key));
        } else if (key in moves && state.mode === 'wipe' && event.target.type !== 'range') {
            event.preventDefault();
            moveWipe(state.wipe + moves[key]);
        }
    });

    // Dragging anywhere in the picture moves the wipe.
    function drag(event) {
        if (state.mode === 'wipe' && event.buttons === 1) {
            const box = canvas.getBoundingClientRect();
            moveWipe((event.clientX - box.left) / box.width);
        }
    }
    inner.addEventListener('pointerdown', (event) => {
        inner.setPointerCapture(event.pointerId);
        drag(event);
    });
    inner.addEventListener('pointermove', drag);

    // Opens the viewer on a row's picture, in a set of pictures if this set shows the row. The
    // focus returns to the opener.
    function open(row, set, opener) {
        const wanted = figureOf(set, row) ?? document.querySelector(`figure[data-row="${row}"]`);
        Object.assign(state, { row, set: wanted.dataset.set, opener, shows: true, part: 'crop' });
        const shown = [...document.querySelectorAll(`figure[data-set="${state.set}"] img`)];
        const pending = shown.map((image) => image.decode());
        dialog.showModal();
        update();
        fitZoom();
        wipe.focus();
        Promise.allSettled(pending).then(() => dialog.open && update());
    }

    // --- what opens the viewer --------------------------------------------------------------

    function makeOpener(around, row, set, label) {
        const button = document.createElement('button');
        button.type = 'button';
        button.title = label;
        button.append(...around.childNodes);
        button.addEventListener('click', () => open(row, set, button));
        around.append(button);
        return button;
    }

    for (const shown of document.querySelectorAll('figure[data-set][data-row]')) {
        makeOpener(shown, Number(shown.dataset.row), shown.dataset.set, 'Compare with the truth');
    }
    for (const row of document.querySelectorAll('tbody tr[data-row]')) {
        if (document.querySelector(`figure[data-row="${row.dataset.row}"]`)) {
            const cell = row.querySelector('.name') ?? row.cells[0];
            const set = row.closest('table').dataset.set;
            makeOpener(cell, Number(row.dataset.row), set, 'Show the picture').className = 'open';
        }
    }
    return open;
})();
