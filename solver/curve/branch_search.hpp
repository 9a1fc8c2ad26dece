/// @file
/// Search for solutions that the sweep does not meet: isolas, and branches that coexist over the
/// whole range. Newton's method is started from several places with the known solutions x_k divided
/// out ("deflation"), at both ends of the range, at seven frequencies inside, at the peaks of the
/// curve, beside its folds, and at the resonances of the free and of the stuck structure; at the
/// one frequency where the range is one:
///
///   F(x) = m(x) R(x),     m = Π_k ( σ²/‖x − x_k‖² + 1 )
///
/// so that it cannot find them again; its step is Newton's own, scaled: with g = ∇m/m
///
///   δ = −J⁻¹R / (1 + gᵀ J⁻¹R)
///
/// At the ends of the range the curves that begin at resonances beside it, up to a quarter of the
/// frequency away, come in as well: a branch that leans into the range rises there.
///
/// What is found is followed both ways to the ends of its branch; at a single frequency it is a
/// point, and the branches of the known solutions are followed about the resonances near by: where
/// they fold and come back is another solution. Nothing found proves nothing.
///
/// Where forces are dear, starts are tried with cheaper ones (ContinuationOptions::search_scene),
/// and what these find is solved for with those of the scene.
///
/// Source: the deflation operator of Farrell, Birkisson & Funke, SIAM J. Sci. Comput. 37 (2015)
/// A2026, power 2, shift 1; starts and following are this project's.
#pragma once

#include "solver/continuation.hpp"

namespace microslip::solver {

/// Adds the branches found, the number of starts and the work to the curve.
/// @param curve    of the scene over the range of the options; its solutions are the known ones.
void search_branches(const Scene& scene, const ContinuationOptions& options, ResponseCurve& curve);

}  // namespace microslip::solver
