// What became of a variant, as index files and manifests tell it: nothing that changes from run to
// run.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bakers/field/baked.h"
#include "bakers/io/manifest/manifest.h"
#include "config/diagnostics/diagnostic.h"

namespace skybake {

// One asset of a variant.
struct VariantAsset {
    std::string name;
    std::string kind;
    std::string key;  // see AssetIdentity
    std::vector<int> size;
    std::optional<ErrorFigures> lookup_error;  // none where it was not measured
    std::optional<ErrorFigures> texel_error;
    std::string content_hash;
    std::vector<std::string> files;  // relative to the variant's folder
};

VariantAsset variant_asset(const ManifestAsset& entry);

enum class VariantStatus {
    done,
    failed,   // its diagnostics say why
    missing,  // not made yet
};

std::string_view spell(VariantStatus status);

struct VariantResult {
    int index = 0;
    std::string name;  // of its folder
    VariantStatus status = VariantStatus::missing;
    std::vector<VariantAsset> assets;             // of one that is done
    std::vector<config::Diagnostic> diagnostics;  // of one that failed; warnings of others
};

}  // namespace skybake
