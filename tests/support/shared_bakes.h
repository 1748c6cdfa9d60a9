// Bakes of small recipes that share what equal needs ask for: solved light, tables of sunlight, fits
// of colours. What they share changes no bit of an asset (tests/incremental/intermediates_test.cpp).
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <span>
#include <vector>

#include "bakers/assets/registry/registry.h"
#include "bakers/field/baked.h"
#include "bakers/math/intermediates.h"
#include "tests/support/outcomes.h"

namespace skybake::test {

class SharedBakes {
  public:
    // Bakes an asset without a certificate. What it is made from is kept until this object ends.
    config::Outcome<Baked> outcome(const config::Recipe& recipe, const config::Bake& bake) {
        expected_.push_back(
            shared_.expect(needs_of(recipe.parameters, std::span(&bake, 1), Certification::off)));
        return bake_asset(
            recipe, bake,
            {.threads = 2, .certification = Certification::off, .intermediates = &shared_});
    }

    // Bakes an asset that no diagnostic is said about.
    Baked baked(const config::Recipe& recipe, const config::Bake& bake) {
        return test::without_diagnostics(outcome(recipe, bake));
    }

    // How many things were made for the bakes.
    int made() const { return shared_.made(); }

  private:
    Intermediates shared_{std::int64_t{1} << 30};
    std::vector<Intermediates::Expected> expected_;
};

}  // namespace skybake::test
