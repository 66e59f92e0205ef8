// Packs a glTF file in five ways: PREFIXdraco.glb, PREFIXmeshopt.glb and so on.
// Usage: node pack_gltf.mjs FILE PREFIX
// test_gltf.c reads data/gltf/packed_*.glb, which are made of plain.gltf.
// npm: @gltf-transform/core @gltf-transform/extensions @gltf-transform/functions draco3dgltf
// meshoptimizer sharp ktx2-encoder
import { NodeIO } from '@gltf-transform/core';
import { ALL_EXTENSIONS, KHRTextureBasisu } from '@gltf-transform/extensions';
import { draco, meshopt, quantize, textureCompress } from '@gltf-transform/functions';
import draco3d from 'draco3dgltf';
import { MeshoptEncoder, MeshoptDecoder } from 'meshoptimizer';
import { encodeToKTX2 } from 'ktx2-encoder';
import sharp from 'sharp';

const [file, prefix] = process.argv.slice(2);
await MeshoptEncoder.ready;
const io = new NodeIO().registerExtensions(ALL_EXTENSIONS).registerDependencies({
  'draco3d.encoder': await draco3d.createEncoderModule(),
  'draco3d.decoder': await draco3d.createDecoderModule(),
  'meshopt.encoder': MeshoptEncoder,
  'meshopt.decoder': MeshoptDecoder,
});
const decode = async (bytes) => {
  const { data, info } = await sharp(bytes).ensureAlpha().raw().toBuffer({ resolveWithObject: true });
  return { data: new Uint8Array(data), width: info.width, height: info.height };
};
const ktx2 = async (document) => {
  document.createExtension(KHRTextureBasisu);
  for (const texture of document.getRoot().listTextures()) {
    texture.setImage(await encodeToKTX2(texture.getImage(), {
      isUASTC: false, imageDecoder: decode, isKTX2File: true }));
    texture.setMimeType('image/ktx2');
  }
};
const ways = {
  draco: [draco()],
  meshopt: [meshopt({ encoder: MeshoptEncoder, level: 'medium' })],
  quantized: [quantize()],
  webp: [textureCompress({ encoder: sharp, targetFormat: 'webp', lossless: true })],
  ktx2: [ktx2],
};
for (const [name, steps] of Object.entries(ways)) {
  const document = await io.read(file);
  await document.transform(...steps);
  for (const e of document.getRoot().listExtensionsUsed()) e.setRequired(true);
  await io.write(`${prefix}${name}.glb`, document);
}
