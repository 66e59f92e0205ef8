// Reads WebP pictures, lossy and lossless, and refuses KTX2 textures with advice.
#include "assets/picture/picture_private.h"

#include <string.h>

bool dip_picture_is_webp(const PictureFile *file) {
    return file->size_bytes >= 12 && memcmp(file->bytes, "RIFF", 4) == 0 &&
           memcmp(file->bytes + 8, "WEBP", 4) == 0;
}

bool dip_picture_is_ktx2(const PictureFile *file) {
    static const uint8_t begin[12] = {0xab, 'K',  'T',  'X',  ' ',  '2',
                                      '0',  0xbb, '\r', '\n', 0x1a, '\n'};
    return file->size_bytes >= sizeof begin && memcmp(file->bytes, begin, sizeof begin) == 0;
}

bool dip_picture_refuse_ktx2(const PictureFile *file, DipPicture *picture) {
    (void)picture;
    return dip_error_set(file->err, DIP_ERROR_FORMAT, file->name, 0, NULL,
                         "KTX2 textures are not read: convert it to PNG, for example by the "
                         "program ktx (ktx extract) of KTX-Software");
}

#ifdef DIP_HAS_WEBP

#include <webp/decode.h>

static bool refuse(const PictureFile *file, VP8StatusCode status) {
    switch (status) {
    case VP8_STATUS_OUT_OF_MEMORY:
        return dip_picture_out_of_memory(file);
    case VP8_STATUS_NOT_ENOUGH_DATA:
        return dip_picture_truncated(file);
    default:
        return dip_error_set(file->err, DIP_ERROR_FORMAT, file->name, 0, NULL,
                             "the WebP picture is malformed or an animation");
    }
}

bool dip_picture_read_webp(const PictureFile *file, DipPicture *picture) {
    WebPDecoderConfig config;
    if (!WebPInitDecoderConfig(&config)) {
        return refuse(file, VP8_STATUS_UNSUPPORTED_FEATURE);
    }
    VP8StatusCode status = WebPGetFeatures(file->bytes, file->size_bytes, &config.input);
    if (status != VP8_STATUS_OK || config.input.has_animation) {
        return refuse(file, status);
    }
    const int width = config.input.width;
    const int height = config.input.height;
    if (!dip_picture_check_size(file, width, height) ||
        !dip_picture_allocate(file, width, height, 1, picture)) {
        return false;
    }
    picture->has_alpha = config.input.has_alpha != 0;
    config.output.colorspace = MODE_RGBA;
    config.output.is_external_memory = 1;
    config.output.u.RGBA.rgba = picture->rgba8;
    config.output.u.RGBA.stride = 4 * width;
    config.output.u.RGBA.size = 4 * (size_t)width * (size_t)height;
    status = WebPDecode(file->bytes, file->size_bytes, &config);
    WebPFreeDecBuffer(&config.output);
    return status == VP8_STATUS_OK || refuse(file, status);
}

#else

bool dip_picture_read_webp(const PictureFile *file, DipPicture *picture) {
    (void)picture;
    return dip_error_set(file->err, DIP_ERROR_FORMAT, file->name, 0, NULL,
                         "this build of Diptych lacks the reader of WebP pictures: install "
                         "libwebp-dev and build again");
}

#endif
