// The light in which pictures show clouds: the tables of an air, and its solved sky as a camera sees
// it. Each is made once, kept while this object lives, and taken from files where somebody has
// baked it.
#pragma once

#include <array>
#include <optional>
#include <string>

#include "bakers/math/bake_options.h"
#include "bakers/math/intermediates.h"
#include "bakers/preview/bake_assets.h"
#include "bakers/render/cloud_view.h"
#include "config/recipe/recipe.h"

namespace skybake {

// Returns the recipe if it states an atmosphere of three or four wavelengths, which one table holds, else null.
const Recipe* stated_air(const Recipe* recipe);

class PictureLight {
  public:
    // The intermediates must outlive this object; null: it has its own. The sources and the cache of
    // `files` are used.
    explicit PictureLight(Intermediates* intermediates = nullptr, AssetMemo files = {});

    // The functions below take the air of a recipe, or that of the preset `earth` if it is null. They
    // use the threads and the progress of `options`, and return nothing after an interruption.

    // Returns a transmittance and a multiple_scattering table, with their recipe. Errors are those of
    // bake_asset.
    Outcome<PreviewAssets> tables(const Recipe* air, const BakeOptions& options);

    // Returns the sky of a camera in the air under a sun. Returns nothing for air whose light cannot
    // be solved for.
    std::optional<SolvedSky> sky(const Recipe* air, const SolvedSky::Place& place,
                                 const BakeOptions& options);

  private:
    Outcome<PreviewAssets> bake(const Recipe* air, const std::string& sections,
                                BakeOptions options);

    Intermediates own_;
    Intermediates& intermediates_;
    AssetMemo memo_;
    // The needs of a sky with another camera or sun: those of the preset, and of the last recipe.
    std::array<Intermediates::Expected, 2> expected_;
};

}  // namespace skybake
