#include "visibility/ring.h"

namespace shodo {

namespace {

/// The vertices inserted in an edge, one after the other.
class Chain {
 public:
  Chain(const RingEdge& edge, std::span<const LatticePoint> sites, bool with_drawn)
      : edge_(&edge), sites_(sites), with_drawn_(with_drawn) {
    skip();
  }

  bool ended() const { return next_ == edge_->inserted.size(); }

  RingVertex take() {
    RingVertex vertex;
    vertex.point = sites_[edge_->inserted[next_].site];
    const LatticeVector along = edge_->to.point - edge_->from.point;
    const std::int64_t whole = dot(along, along);
    // The nearest place on the edge; a fraction within 0 .. 1 but for the rounding of vertices.
    const double t =
        whole == 0 ? 0.0
                   : static_cast<double>(dot(vertex.point - edge_->from.point, along)) / static_cast<double>(whole);
    vertex.u = between(edge_->from.u, edge_->to.u, t);
    vertex.v = between(edge_->from.v, edge_->to.v, t);
    ++next_;
    skip();
    return vertex;
  }

 private:
  static std::int32_t between(std::int32_t a, std::int32_t b, double t) {
    const double part = t < 0 ? 0 : t > 1 ? 1 : t;
    const double value = static_cast<double>(b - a) * part;
    return a + static_cast<std::int32_t>(value < 0 ? value - 0.5 : value + 0.5);
  }

  void skip() {
    while (!with_drawn_ && next_ < edge_->inserted.size() && edge_->inserted[next_].drawn != 0) ++next_;
  }

  const RingEdge* edge_;
  std::span<const LatticePoint> sites_;
  std::size_t next_ = 0;
  bool with_drawn_;
};

struct Cutter {
  std::span<const LatticePoint> sites;
  bool with_drawn;
  const TriangleSink& sink;

  bool empty(const RingEdge& edge) const { return Chain(edge, sites, with_drawn).ended(); }
  void emit(const RingVertex& a, const RingVertex& b, const RingVertex& c) const { sink.take(sink.context, a, b, c); }

  /// Triangles from `apex` to each piece of the edge.
  void fan(const RingVertex& apex, const RingEdge& edge) const {
    RingVertex last = edge.from;
    for (Chain chain(edge, sites, with_drawn); !chain.ended();) {
      const RingVertex next = chain.take();
      emit(apex, last, next);
      last = next;
    }
    emit(apex, last, edge.to);
  }

  void triangle(const RingEdge& ab, const RingEdge& bc, const RingEdge& ca) const {
    if (empty(ab)) {
      if (!empty(bc)) return triangle(bc, ca, ab);
      if (!empty(ca)) return triangle(ca, ab, bc);
      return emit(ab.from, bc.from, ca.from);
    }
    Chain chain(ab, sites, with_drawn);
    RingVertex last = chain.take();
    fan(last, ca);
    while (!chain.ended()) {
      const RingVertex next = chain.take();
      emit(ca.from, last, next);
      last = next;
    }
    fan(last, bc);
  }
};

RingEdge diagonal(const RingVertex& from, const RingVertex& to) {
  RingEdge edge;
  edge.from = from;
  edge.to = to;
  return edge;
}

}  // namespace

void cut_ring(const Ring& ring, std::span<const LatticePoint> sites, bool with_drawn, const TriangleSink& sink) {
  const Cutter cutter{sites, with_drawn, sink};
  const RingEdge* e = ring.edge;
  if (ring.edges == 3) return cutter.triangle(e[0], e[1], e[2]);
  const std::uint32_t k = ring.cut_from_1 ? 1 : 0;
  const RingEdge &first = e[k], &second = e[k + 1], &third = e[k + 2], &fourth = e[(k + 3) % 4];
  cutter.triangle(first, second, diagonal(third.from, first.from));
  cutter.triangle(third, fourth, diagonal(first.from, third.from));
}

}  // namespace shodo
