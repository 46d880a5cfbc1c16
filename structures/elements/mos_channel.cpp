#include "courant/structures/elements/mos_channel.hpp"

#include <cmath>

namespace courant::elements {

Expr MosChannel::current(const Expr& v_gs, const Expr& v_ds, const Expr& v_bs) const {
  return select(v_ds < Expr(0.0), -forward(v_gs - v_ds, -v_ds, v_bs - v_ds),
                forward(v_gs, v_ds, v_bs));
}

Expr MosChannel::forward(const Expr& v_gs, const Expr& v_ds, const Expr& v_bs) const {
  Expr onset = v_gs - threshold;
  if (body != 0.0) {
    const double root = std::sqrt(surface);
    const Expr below = sqrt(surface - min(v_bs, Expr(0.0)));
    const Expr above = max(root - v_bs / (2.0 * root), Expr(0.0));
    onset -= body * (select(v_bs < Expr(0.0), below, above) - root);
  }
  const Expr a = max(onset, Expr(0.0)), linear = v_ds * (a - v_ds / 2.0);
  return transconductance * (1.0 + modulation * v_ds) * select(v_ds < a, linear, square(a) / 2.0);
}

}  // namespace courant::elements
