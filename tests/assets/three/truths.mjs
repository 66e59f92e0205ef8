// Draws models with three.js in headless Chromium with a software renderer, as a truth that is
// independent of Diptych.
// Usage: node truths.mjs JOBS.json THREE
//
// JOBS.json: {width, height, scale, background: [R, G, B], jobs: [{model, out, views}]}. A view is
// [x, y, z, qx, qy, qz, qw, fov, seconds]; without views, the page chooses one. THREE: the folder
// of the npm package. Writes OUT.views.json and OUT.0.png, OUT.1.png, ... for each job; for a model
// that three.js refuses, OUT.refused.txt.
// Pixels come by HTTP from a float render target: no compositor, tone mapping or colour management
// touches them.
import http from 'node:http';
import fs from 'node:fs';
import os from 'node:os';
import path from 'node:path';
import zlib from 'node:zlib';
import { spawn } from 'node:child_process';
import { fileURLToPath } from 'node:url';

const SECONDS_WITHOUT_PICTURE = 240;
const here = path.dirname(fileURLToPath(import.meta.url));
const options = JSON.parse(fs.readFileSync(process.argv[2], 'utf8'));
const three = process.argv[3];
const { width, height, jobs } = options;

function chunk(type, data) {
  const name = Buffer.from(type, 'latin1');
  const bytes = Buffer.concat([Buffer.alloc(4), name, data, Buffer.alloc(4)]);
  bytes.writeUInt32BE(data.length, 0);
  let crc = ~0;
  for (const byte of bytes.subarray(4, 8 + data.length)) {
    crc ^= byte;
    for (let k = 0; k < 8; ++k) crc = (crc >>> 1) ^ (0xedb88320 & -(crc & 1));
  }
  bytes.writeUInt32BE(~crc >>> 0, 8 + data.length);
  return bytes;
}

function png(rgb) {
  const rows = Buffer.alloc((width * 3 + 1) * height);
  for (let y = 0; y < height; ++y) {
    rgb.copy(rows, y * (width * 3 + 1) + 1, y * width * 3, (y + 1) * width * 3);
  }
  const head = Buffer.alloc(13);
  head.writeUInt32BE(width, 0);
  head.writeUInt32BE(height, 4);
  head.set([8, 2, 0, 0, 0], 8);
  return Buffer.concat([Buffer.from([137, 80, 78, 71, 13, 10, 26, 10]), chunk('IHDR', head),
    chunk('IDAT', zlib.deflateSync(rows)), chunk('IEND', Buffer.alloc(0))]);
}

// The sRGB code of linear light.
function encode(x) {
  const light = Math.min(1, Math.max(0, x));
  const code = light <= 0.0031308 ? 12.92 * light : 1.055 * Math.pow(light, 1 / 2.4) - 0.055;
  return Math.round(255 * code);
}

let chromium = null;
let watch = null;
let finishing = false;
const profile = fs.mkdtempSync(path.join(os.tmpdir(), 'truths-'));

function finish(code) {
  if (finishing) return;
  finishing = true;
  const leave = () => {
    fs.rmSync(profile, { recursive: true, force: true, maxRetries: 5, retryDelay: 100 });
    process.exit(code);
  };
  if (!chromium || chromium.exitCode !== null) {
    leave();
  } else {
    chromium.on('exit', leave);
    chromium.kill('SIGTERM');
    setTimeout(leave, 5000);
  }
}

function restartWatch() {
  clearTimeout(watch);
  watch = setTimeout(() => {
    console.error(`no picture for ${SECONDS_WITHOUT_PICTURE} s`);
    finish(1);
  }, SECONDS_WITHOUT_PICTURE * 1000);
}

function take(url, body) {
  const out = url.searchParams.has('job') ? jobs[Number(url.searchParams.get('job'))].out : null;
  restartWatch();
  switch (url.pathname) {
    case '/picture': {
      const light = new Float32Array(body.buffer, body.byteOffset, width * height * 3);
      const rgb = Buffer.from(light.map(encode));
      fs.writeFileSync(`${out}.${url.searchParams.get('view')}.png`, png(rgb));
      break;
    }
    case '/views':
      fs.writeFileSync(`${out}.views.json`, body);
      break;
    case '/refused':
      fs.writeFileSync(`${out}.refused.txt`, body);
      break;
    case '/done':
      finish(0);
      break;
    default:
      console.error(body.toString());
      finish(1);
  }
}

const TYPES = { '.js': 'text/javascript', '.html': 'text/html', '.wasm': 'application/wasm' };

function send(url, response) {
  const parts = decodeURIComponent(url.pathname).split('/').slice(1);
  let file = path.join(here, ...parts);
  if (parts[0] === 'three') file = path.join(three, ...parts.slice(1));
  if (parts[0] === 'model') file = path.join('/', ...parts.slice(1));
  fs.readFile(file, (error, data) => {
    response.statusCode = error ? 404 : 200;
    response.setHeader('Content-Type', TYPES[path.extname(file)] || 'application/octet-stream');
    response.end(data);
  });
}

for (const job of jobs) job.model = path.resolve(job.model);
const server = http.createServer((request, response) => {
  const url = new URL(request.url, 'http://x');
  if (request.method === 'POST') {
    const parts = [];
    request.on('data', (data) => parts.push(data));
    request.on('end', () => {
      response.end();
      take(url, Buffer.concat(parts));
    });
  } else if (url.pathname === '/jobs') {
    response.end(JSON.stringify(options));
  } else {
    send(url, response);
  }
});
server.listen(0, '127.0.0.1', () => {
  restartWatch();
  chromium = spawn(process.env.CHROMIUM || 'chromium', ['--headless=new', '--no-sandbox',
    '--use-angle=swiftshader', '--enable-unsafe-swiftshader', '--no-first-run',
    '--disable-extensions', `--user-data-dir=${profile}`,
    `http://127.0.0.1:${server.address().port}/truths.html`], { stdio: 'ignore' });
  chromium.on('error', (error) => {
    console.error(error.message);
    finish(1);
  });
  chromium.on('exit', () => {
    if (!finishing) console.error('Chromium has ended early');
    finish(1);
  });
});
