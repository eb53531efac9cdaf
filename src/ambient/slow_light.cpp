#include "ambient/slow_light.h"

#include "base/interrupted.h"

namespace shodo {

namespace {

constexpr double kLeastOfPair = 0.25;        // v
constexpr double kLeastDeterminant = 1.0 / 1024;
constexpr double kCoarseReduction = 0x1p-80;  // of the squared residual: the correction must be the same linear map
constexpr std::uint32_t kPatience = 30;       // steps without a smaller residual

/// Vectors by node; those of blocks matter in the first two only.
struct Vectors {
  std::span<double> direction;  // y, as fluxes
  std::span<double> image;      // sum over j of v_ij direction_j
  std::span<double> residual;   // t_i times that of y
  std::span<double> partner;    // its node + half of t_i t_j v_ij; i + 0: none; -1: not among the unknown
};

Vectors vectors_of(const Solver& solver, std::size_t nodes) {
  const bool grey = solver.sent.size() < 2 * nodes;
  return {solver.sent.first(nodes), solver.gathered.first(nodes),
          grey ? solver.spare.first(nodes) : solver.sent.subspan(nodes, nodes),
          grey ? solver.spare.subspan(nodes, nodes) : solver.gathered.subspan(nodes, nodes)};
}

/// One channel at work.
struct Search {
  const SolverRun& run;
  std::uint32_t channel;
  const Surfaces& surfaces;
  Vectors at;
  std::uint32_t channels;

  std::size_t value(std::uint32_t i) const { return std::size_t{surfaces.patch_at[i]} * channels + channel; }
  double& ambient(std::uint32_t i) const { return run.solver.ambient_lx[value(i)]; }
  std::uint32_t partner(std::uint32_t i) const { return static_cast<std::uint32_t>(at.partner[i]); }
};

/// An unknown: t_i and rho_i R_i.
struct Unknown {
  std::uint32_t node, place;
  double t, flux;  // flux of 1 lx
};

double scale_of(const Search& search, std::uint32_t i, double reflectance) {
  return square_root(reflectance * search.surfaces.root_area[i] * search.run.matrix.factor[i]);
}

/// Calls visit(unknown), nodes ascending.
template <class Visit>
void for_unknowns(const Search& search, Visit&& visit) {
  MeshWalk walk(search.surfaces, 0);
  for (std::uint32_t i = 0; i < search.surfaces.size(); ++i) {
    walk.go_to(i);
    if (search.at.partner[i] < 0) continue;
    const double rho = walk.reflectance(i)[search.channel];
    visit(Unknown{i, walk.place(), scale_of(search, i, rho), rho * search.surfaces.root_area[i]});
  }
}

/// What every patch sends with the light it has; which are unknown.
void start(const Search& search) {
  const Sparsity& sparsity = search.run.matrix.sparsity;
  MeshWalk walk(search.surfaces, 0);
  for (std::uint32_t i = 0; i < search.surfaces.size(); ++i) {
    search.at.direction[i] = 0;
    search.at.partner[i] = -1;
    walk.go_to(i);
    if (search.surfaces.is_block(i) || !(search.surfaces.root_area[i] > 0) || !sparsity.sends(i)) continue;
    const double rho = walk.reflectance(i)[search.channel], ambient = search.ambient(i);
    const double total = search.run.direct.patch_lx[search.value(i)] + ambient;
    search.at.direction[i] = rho * search.surfaces.root_area[i] * total;
    if (rho > 0 && ambient > 0 && search.run.matrix.factor[i] > 0) search.at.partner[i] = i;
  }
}

/// Notes v of a pair where it is the greatest of either so far.
void note_pair(const Search& search, std::uint32_t i, std::uint32_t j, double v) {
  double& of_i = search.at.partner[i];
  double& of_j = search.at.partner[j];
  if (v < kLeastOfPair || of_i < 0 || of_j < 0) return;
  const double half = v < 1 ? v / 2 : 0.5;
  if (half > of_i - search.partner(i)) of_i = j + half;
  if (half > of_j - search.partner(j)) of_j = i + half;
}

/// Pairs are what both agree on.
void settle_pairs(const Search& search) {
  MeshWalk walk(search.surfaces, 0);
  for (std::uint32_t i = 0; i < search.surfaces.size(); ++i) {
    walk.go_to(i);
    if (search.at.partner[i] < 0) continue;
    const std::uint32_t j = search.partner(i);
    if (j == i || search.partner(j) != i) {
      search.at.partner[i] = i;
    } else if (j > i) {
      double room[3];
      const double rho_j = search.surfaces.reflectance(j, room)[search.channel];
      const double coupling = 2 * (search.at.partner[i] - j) * scale_of(search, j, rho_j) *
                              scale_of(search, i, walk.reflectance(i)[search.channel]);
      const bool well = 1 - coupling * coupling > kLeastDeterminant;
      search.at.partner[i] = well ? j + coupling / 2 : i;
      search.at.partner[j] = well ? i + coupling / 2 : j;
    }
  }
}

/// image = V direction, in one pass; in the first one pairs are sought. False: interrupted.
bool multiply(const Search& search, bool first) {
  Matrix& matrix = search.run.matrix;
  const Surfaces& surfaces = search.surfaces;
  const std::uint32_t n = surfaces.size();
  const std::span<double> sent = search.at.direction, image = search.at.image;
  sum_up(surfaces, 0, n, 1, sent);
  for (double& value : image) value = 0;
  Intersector uncounted(search.run.intersector);
  RowCursor rows[kGenerations];
  for (std::uint8_t g = 0; g < matrix.generations(); ++g) rows[g] = RowCursor(matrix, g);
  for (std::uint32_t i = 0; i < n; ++i) {
    const bool tells = !matrix.keeps(matrix.sparsity.now(), i) || i % 256 == 0;
    if (tells && !search.run.progress.go_on(Stage::kSolution, i, n)) return false;
    double sum = 0;
    for (std::uint8_t g = 0; g < matrix.generations(); ++g) {
      const std::uint16_t* row = rows[g].row(matrix, uncounted, i);
      for (RowReader<RowFormat::kEither> entry(row, i, matrix.doubles()); entry.next();) {
        const double v = entry.value();
        sum += v * sent[entry.column()];
        image[entry.column()] += v * sent[i];
        if (first) note_pair(search, i, entry.column(), v);
      }
    }
    image[i] += sum;
  }
  for (std::uint32_t b = 0; b < n; ++b) {
    if (surfaces.is_block(b) && surfaces.root_area[b] > 0) hand_down<1>(surfaces, b, &image[b], image);
  }
  return true;
}

/// t_i times what the pair of i makes of the residual.
double of_pair(const Search& search, std::uint32_t i) {
  const std::uint32_t j = search.partner(i);
  const double coupling = 2 * (search.at.partner[i] - j);
  return (search.at.residual[i] + coupling * search.at.residual[j]) / (1 - coupling * coupling);
}

/// The coarse part of the preconditioned residual, in group_delta: y_i = R_i u of its group.
void solve_coarse(const Search& search) {
  Coarse& coarse = search.run.matrix.coarse;
  const std::span<double> sums = coarse.residual();
  for (double& sum : sums) sum = 0;
  for_unknowns(search, [&](const Unknown& k) {
    sums[coarse.group_at(k.node, k.place)] += search.surfaces.root_area[k.node] * (search.at.residual[k.node] / k.t);
  });
  const std::uint32_t groups = coarse.groups();
  coarse.solve(search.run.solver.group_reflectance.subspan(search.channel * groups, groups), 2 * groups,
               kCoarseReduction, search.run.solver.group_delta);
}

/// r . z, z the preconditioned residual.
double preconditioned_size(const Search& search) {
  const Coarse& coarse = search.run.matrix.coarse;
  double size = 0;
  for_unknowns(search, [&](const Unknown& k) {
    const double u = search.run.solver.group_delta[coarse.group_at(k.node, k.place)];
    const double z = of_pair(search, k.node) + search.surfaces.root_area[k.node] * u / k.t;
    size += search.at.residual[k.node] * z;
  });
  return size;
}

/// The new direction, z + keep p.
void turn(const Search& search, double keep) {
  const Coarse& coarse = search.run.matrix.coarse;
  for_unknowns(search, [&](const Unknown& k) {
    const double u = search.run.solver.group_delta[coarse.group_at(k.node, k.place)];
    const double z = of_pair(search, k.node) * k.t + search.surfaces.root_area[k.node] * u;
    search.at.direction[k.node] = z + keep * search.at.direction[k.node];
  });
}

/// p . (1 / t^2 - V) p
double curvature_of(const Search& search) {
  double sum = 0;
  for_unknowns(search, [&](const Unknown& k) {
    const double p = search.at.direction[k.node];
    sum += p * (p / (k.t * k.t) - search.at.image[k.node]);
  });
  return sum;
}

/// The residual as it is at first. Nothing has a direction then. Returns the most that a row asks for beside its value.
double first_residual(const Search& search) {
  double most = 0;
  for (double& value : search.at.residual) value = 0;
  for_unknowns(search, [&](const Unknown& k) {
    const double factor = search.run.matrix.factor[k.node];
    const double asked = factor * search.at.image[k.node] - search.ambient(k.node);
    search.at.residual[k.node] = k.t * (asked / factor);
    if (magnitude(asked) > most) most = magnitude(asked);
  });
  for (double& value : search.at.direction) value = 0;
  return most;
}

/// Goes `length` of the direction; returns as above.
double step(const Search& search, double length) {
  double most = 0;
  for_unknowns(search, [&](const Unknown& k) {
    const double p = search.at.direction[k.node];
    search.ambient(k.node) += length * p / k.flux;
    double& residual = search.at.residual[k.node];
    residual -= length * (p / k.t - k.t * search.at.image[k.node]);
    const double asked = search.run.matrix.factor[k.node] * residual / k.t;
    if (magnitude(asked) > most) most = magnitude(asked);
  });
  return most;
}

}  // namespace

Status solve_slow_light(const SolverRun& run, std::uint32_t channel, double allowed_lx, Statistics& statistics) {
  const Surfaces& surfaces = run.matrix.surfaces;
  const Search search{run, channel, surfaces, vectors_of(run.solver, surfaces.size()), surfaces.scene->channels};
  start(search);
  ++statistics.sweeps;
  if (!multiply(search, true)) return interrupted();
  settle_pairs(search);
  double most = first_residual(search), least = most, size = 0;
  for (std::uint32_t since = 0; most > allowed_lx && since < kPatience; ++since) {
    solve_coarse(search);
    const double next = preconditioned_size(search);
    if (!(next > 0)) break;
    turn(search, size > 0 ? next / size : 0);
    size = next;
    ++statistics.sweeps;
    if (!multiply(search, false)) return interrupted();
    const double curvature = curvature_of(search);
    if (!(curvature > 0)) break;
    most = step(search, size / curvature);
    if (most < least) {
      least = most;
      since = 0;
    }
  }
  // Rounding: light is never negative.
  for_unknowns(search, [&](const Unknown& k) {
    if (search.ambient(k.node) < 0) search.ambient(k.node) = 0;
  });
  return {};
}

}  // namespace shodo
