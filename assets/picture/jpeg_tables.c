// Checks the tables and scans of a JPEG file before stb_image decodes it. Version 2.27 of stb_image
// writes beyond a Huffman table with more than 256 codes, decodes scans with tables that the file
// does not define, and accepts files without scans.
#include "assets/picture/picture_private.h"

enum {
    MARKER_SOF_FIRST = 0xc0, // Frame headers that stb_image decodes: baseline, extended and
    MARKER_SOF_LAST = 0xc2,  // progressive.
    MARKER_DHT = 0xc4,       // Huffman tables
    MARKER_RST_FIRST = 0xd0, // Restart markers, which lie within the data of a scan.
    MARKER_RST_LAST = 0xd7,
    MARKER_SOI = 0xd8, // Start of the picture.
    MARKER_EOI = 0xd9, // End of the picture.
    MARKER_SOS = 0xda, // Header of a scan.
    MARKER_DQT = 0xdb, // Quantisation tables.
    MARKER_END = -1,   // The file ends.
    MAX_CODES = 256,
    MAX_TABLES = 4,
    MAX_COMPONENTS = 4
};

typedef struct Jpeg {
    const uint8_t *bytes;
    size_t size_bytes;
    size_t at;                       // Next byte to read.
    bool has_huffman[2][MAX_TABLES]; // [0: DC, 1: AC][table]
    bool has_quantisation[MAX_TABLES];
    bool progressive;
    int component_count; // 0 until the frame header is read.
    uint8_t component_id[MAX_COMPONENTS];
    uint8_t component_quantisation[MAX_COMPONENTS];
    bool component_scanned[MAX_COMPONENTS];
} Jpeg;

// Beyond the end of the file, stb_image reads zeros.
static int next_byte(Jpeg *jpeg) {
    return jpeg->at < jpeg->size_bytes ? jpeg->bytes[jpeg->at++] : 0;
}

static int next_number(Jpeg *jpeg) {
    const int high = next_byte(jpeg);
    return high << 8 | next_byte(jpeg);
}

// Finds the next marker. Skips other bytes, such as the data of a scan.
static int next_marker(Jpeg *jpeg) {
    while (jpeg->at < jpeg->size_bytes) {
        int byte = next_byte(jpeg);
        const bool begins = byte == 0xff;
        while (byte == 0xff && jpeg->at < jpeg->size_bytes) {
            byte = next_byte(jpeg);
        }
        if (begins && byte != 0 && byte != 0xff &&
            (byte < MARKER_RST_FIRST || byte > MARKER_RST_LAST)) {
            return byte;
        }
    }
    return MARKER_END;
}

static bool read_huffman_tables(Jpeg *jpeg, int left) {
    while (left > 0) {
        const int table = next_byte(jpeg);
        int code_count = 0;
        for (int i = 0; i < 16; ++i) {
            code_count += next_byte(jpeg);
        }
        if (table >> 4 > 1 || (table & 15) >= MAX_TABLES || code_count > MAX_CODES) {
            return false;
        }
        jpeg->has_huffman[table >> 4][table & 15] = true;
        jpeg->at += (size_t)code_count;
        left -= 17 + code_count;
    }
    return left == 0;
}

static bool read_quantisation_tables(Jpeg *jpeg, int left) {
    while (left > 0) {
        const int table = next_byte(jpeg);
        const int size_bytes = table >> 4 ? 128 : 64;
        if (table >> 4 > 1 || (table & 15) >= MAX_TABLES) {
            return false;
        }
        jpeg->has_quantisation[table & 15] = true;
        jpeg->at += (size_t)size_bytes;
        left -= 1 + size_bytes;
    }
    return left == 0;
}

static bool read_frame_header(Jpeg *jpeg) {
    jpeg->at += 5; // bits per sample, height and width
    const int count = next_byte(jpeg);
    if (jpeg->component_count > 0 || count < 1 || count > MAX_COMPONENTS) {
        return false;
    }
    for (int i = 0; i < count; ++i) {
        jpeg->component_id[i] = (uint8_t)next_byte(jpeg);
        next_byte(jpeg); // sampling factors
        jpeg->component_quantisation[i] = (uint8_t)next_byte(jpeg);
        if (jpeg->component_quantisation[i] >= MAX_TABLES) {
            return false;
        }
    }
    jpeg->component_count = count;
    return true;
}

// Returns the index of the frame's component, or -1.
static int find_component(const Jpeg *jpeg, int id) {
    for (int i = 0; i < jpeg->component_count; ++i) {
        if (jpeg->component_id[i] == id) {
            return i;
        }
    }
    return -1;
}

// Reads the header of a scan. Returns false if the scan needs a table that is not defined.
static bool read_scan_header(Jpeg *jpeg) {
    int component[MAX_COMPONENTS];
    int tables[MAX_COMPONENTS];
    const int count = next_byte(jpeg);
    if (count < 1 || count > jpeg->component_count) {
        return false;
    }
    for (int i = 0; i < count; ++i) {
        component[i] = find_component(jpeg, next_byte(jpeg));
        tables[i] = next_byte(jpeg);
    }
    const int first_coefficient = next_byte(jpeg);
    next_byte(jpeg); // last coefficient
    const bool refines = next_byte(jpeg) >> 4 != 0;
    const bool needs_dc = !jpeg->progressive || (first_coefficient == 0 && !refines);
    const bool needs_ac = !jpeg->progressive || first_coefficient != 0;
    for (int i = 0; i < count; ++i) {
        const int dc = tables[i] >> 4;
        const int ac = tables[i] & 15;
        if (component[i] < 0 || dc >= MAX_TABLES || ac >= MAX_TABLES ||
            !jpeg->has_quantisation[jpeg->component_quantisation[component[i]]] ||
            (needs_dc && !jpeg->has_huffman[0][dc]) || (needs_ac && !jpeg->has_huffman[1][ac])) {
            return false;
        }
        jpeg->component_scanned[component[i]] = true;
    }
    return true;
}

static bool read_segment(Jpeg *jpeg, int marker) {
    const int length = next_number(jpeg);
    const size_t begin = jpeg->at;
    if (length < 2) {
        return false;
    }
    bool ok = true;
    if (marker == MARKER_DHT) {
        ok = read_huffman_tables(jpeg, length - 2);
    } else if (marker == MARKER_DQT) {
        ok = read_quantisation_tables(jpeg, length - 2);
    } else if (marker == MARKER_SOS) {
        ok = read_scan_header(jpeg);
    } else if (marker >= MARKER_SOF_FIRST && marker <= MARKER_SOF_LAST) {
        jpeg->progressive = marker == MARKER_SOF_LAST;
        ok = read_frame_header(jpeg);
    }
    jpeg->at = begin + (size_t)length - 2;
    return ok;
}

static bool bad_table(const PictureFile *file) {
    return dip_error_set(file->err, DIP_ERROR_FORMAT, file->name, 0, NULL,
                         "a Huffman or quantisation table of the JPEG file is malformed or "
                         "missing, accepted files with every table that they use");
}

bool dip_jpeg_check(const PictureFile *file) {
    Jpeg jpeg = {.bytes = file->bytes, .size_bytes = file->size_bytes};
    if (jpeg.size_bytes < 2 || jpeg.bytes[0] != 0xff || next_marker(&jpeg) != MARKER_SOI) {
        return true; // This is no JPEG file.
    }
    for (int marker = next_marker(&jpeg); marker != MARKER_END && marker != MARKER_EOI;
         marker = next_marker(&jpeg)) {
        if (!read_segment(&jpeg, marker)) {
            return bad_table(file);
        }
    }
    for (int i = 0; i < jpeg.component_count; ++i) {
        if (!jpeg.component_scanned[i]) {
            return dip_error_set(file->err, DIP_ERROR_TRUNCATED, file->name, 0, NULL,
                                 "the JPEG file has headers but no picture data, accepted files "
                                 "with a scan of every component");
        }
    }
    return true;
}
