// Constants of the fixed rules on quadrilaterals and triangles.
#pragma once

namespace shodo {

inline constexpr double kGaussTwo = 0.57735026918962576;    // 1 / sqrt 3: 2 points on [-1, 1], degree 3
inline constexpr double kInner = 0.14088324360345806;       // (1 - 1 / sqrt 3) / 3: with the centroid 4 equal weights
                                                            // on a triangle, degree 2
inline constexpr double kRadonNear = 0.10128650732345634;   // (6 - sqrt 15) / 21: 7 points, degree 5 (Radon 1948)
inline constexpr double kRadonFar = 0.47014206410511509;    // (6 + sqrt 15) / 21
inline constexpr double kRadonNearWeight = 0.12593918054482715;  // (155 - sqrt 15) / 1200
inline constexpr double kRadonFarWeight = 0.13239415278850618;   // (155 + sqrt 15) / 1200
inline constexpr double kRadonCentreWeight = 0.225;

}  // namespace shodo
