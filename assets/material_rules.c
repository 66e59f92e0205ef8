// Marks materials by their names: finds the rules that hold for a material, and reports rules that
// no material fits and light maps that cannot be read.
#include "assets/model_parts.h"

#include <string.h>

// Greedy matching with one point of return: after a mismatch, the last `*` takes one byte more. A
// `*` before it never needs to take more, because the last one can take whatever lies between.
bool dip_material_name_fits(const char *pattern, const char *name) {
    const char *star = NULL;
    const char *retry = NULL;
    while (*name) {
        if (*pattern == '*') {
            star = pattern++;
            retry = name;
        } else if (*pattern == '?' || *pattern == *name) {
            // UTF-8: `?` stands for a whole character, so it takes the bytes that continue it, too.
            const bool whole = *pattern == '?';
            ++pattern;
            ++name;
            while (whole && ((unsigned char)*name & 0xc0) == 0x80) {
                ++name;
            }
        } else if (star) {
            pattern = star + 1;
            name = ++retry;
        } else {
            return false;
        }
    }
    while (*pattern == '*') {
        ++pattern;
    }
    return *pattern == '\0';
}

void dip_model_apply_rules(const DipModel *model, const char *name, DipMaterialPlan *plan) {
    static const DipTag tags[DIP_MARK_COUNT] = {[DIP_MARK_SOLID] = DIP_TAG_SOLID,
                                                [DIP_MARK_CLIP] = DIP_TAG_MASK,
                                                [DIP_MARK_GLASS] = DIP_TAG_GLASS,
                                                [DIP_MARK_WATER] = DIP_TAG_WATER,
                                                [DIP_MARK_SKY] = DIP_TAG_SKY};
    for (int i = 0; i < model->rule_count; ++i) {
        const DipMaterialRule *rule = &model->rules[i];
        if (!dip_material_name_fits(rule->pattern, name)) {
            continue;
        }
        if (rule->mark == DIP_MARK_LIGHT_MAP) {
            plan->light_rule = rule;
            plan->light_mapped = true;
        } else {
            plan->tag = tags[rule->mark];
        }
    }
}

static bool fits_any(const DipModel *model, const char *pattern) {
    for (int f = 0; f < model->file_count; ++f) {
        const DipModelFile *file = &model->files[f];
        for (int i = 0; i < file->material_count; ++i) {
            if (dip_material_name_fits(pattern, file->material_names[i])) {
                return true;
            }
        }
    }
    return false;
}

static bool refuse_pattern(const DipModel *model, const DipMaterialRule *rule, DipError *err) {
    DipNameList list = {.left_out = 0};
    for (int f = 0; f < model->file_count; ++f) {
        const DipModelFile *file = &model->files[f];
        for (int i = 0; i < file->material_count; ++i) {
            if (file->material_names[i][0]) {
                dip_name_list_add(&list, file->material_names[i]);
            }
        }
    }
    const char *names = dip_name_list_end(&list);
    return dip_error_set(err, DIP_ERROR_UNKNOWN, rule->file, rule->line, rule->key,
                         "'%.60s' fits no material of the models, accepted %s", rule->pattern,
                         names[0] ? names : "nothing, as no material has a name");
}

static bool fits_a_surface(const DipModel *model, const char *pattern) {
    for (int i = 0; i < model->def.material_count; ++i) {
        if (dip_material_name_fits(pattern, model->materials[i].name)) {
            return true;
        }
    }
    return false;
}

static void warn_of_unused(DipModel *model, const DipMaterialRule *rule) {
    DipError warning;
    dip_error_set(&warning, DIP_ERROR_UNKNOWN, rule->file, rule->line, rule->key,
                  "'%.60s' fits only materials that no surface uses", rule->pattern);
    warning.severity = DIP_SEVERITY_WARNING;
    if (model->warnings) {
        dip_error_list_add(model->warnings, &warning);
    }
}

bool dip_model_check_rules(DipModel *model, DipError *err) {
    for (int i = 0; i < model->rule_count; ++i) {
        const DipMaterialRule *rule = &model->rules[i];
        if (!fits_any(model, rule->pattern)) {
            return refuse_pattern(model, rule, err);
        }
        if (!fits_a_surface(model, rule->pattern)) {
            warn_of_unused(model, rule);
        }
    }
    return true;
}

bool dip_model_check_light_maps(const DipModel *model, DipError *err) {
    for (int i = 0; i < model->rule_count; ++i) {
        const DipMaterialRule *rule = &model->rules[i];
        for (int p = 0; rule->light_map && p < model->picture_count; ++p) {
            const DipPictureEntry *entry = &model->pictures[p];
            if (entry->bytes || entry->error.code == DIP_ERROR_NONE ||
                entry->error.origin == DIP_ORIGIN_RUNTIME ||
                strcmp(entry->name, rule->light_map) != 0) {
                continue;
            }
            return dip_error_set(err, entry->error.code, rule->file, rule->line, rule->key,
                                 "%s: %s", rule->light_map, entry->error.message);
        }
    }
    return true;
}
