// What a reader of a baked folder knows: its files and its manifest.
#pragma once

#include <stdexcept>
#include <string>

#include "tests/incremental/bakes.h"
#include "tests/support/probe_place.h"
#include "tests/support/recipes.h"

namespace skybake::testing {

// A recipe's folder, which lives as long as this does.
struct BakedRecipe {
    explicit BakedRecipe(const std::string& text) {
        TestBake test(recipe_of(text), folder.path());
        test.bake.certification = Certification::off;
        const auto baked = test.run();
        EXPECT_TRUE(baked.value.has_value())
            << (baked.diagnostics.empty() ? "" : baked.diagnostics[0].message);
        manifest = read_manifest(folder.path()).value.value();
    }

    const ManifestAsset& asset(const std::string& name) const {
        for (const ManifestAsset& entry : manifest.assets) {
            if (entry.name == name) return entry;
        }
        throw std::out_of_range(name);
    }

    TemporaryFolder folder;
    Manifest manifest;
};

// tests/recipes/every_asset.toml, baked once for all tests of a run.
inline const BakedRecipe& every_asset() {
    static const BakedRecipe baked(test::recipe_text("every_asset"));
    return baked;
}

using test::at;

}  // namespace skybake::testing
