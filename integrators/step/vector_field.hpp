// VectorField: S_f as the graph of a vector field.
#pragma once

#include <memory>
#include <mutex>

#include "courant/core/expressions/function.hpp"
#include "courant/integrators/certificate/constraint_ladder.hpp"
#include "courant/structures/implicit_system.hpp"

namespace courant {

class EquationSystem;
class Inputs;

// The equations that a VectorField solves, as formulas. Where they give all of y explicitly there is no y, and
// no equation is left: the rate is a formula in x and t.
struct VectorFieldFormulas {
  // Which ladders there is a field for: with gauge freedom it is one of many, that nearest to the
  // last velocity that was evaluated.
  enum class Freedom { none, gauge };
  // Throws std::invalid_argument unless the ladder is regular, or gauge where that is allowed.
  VectorFieldFormulas(std::shared_ptr<const ImplicitSystem> system, const ConstraintLadder& ladder,
                      Freedom freedom);

  std::shared_ptr<const ImplicitSystem> system;
  std::vector<Function::Input> inputs;  // y = (ξ', …, z, …), x, basis, t
  ExprVector equations, rate,
      left_out;       // the equations kept; ẋ, v, z; those of y that are not kept
  ExprVector all;     // the equations of S_f and of M_f, of which they are some
  ExprVector solved;  // the equations kept, with the unknowns that they leave open held at `start`
  std::vector<Index> held;  // these, ascending
  VectorXd start;           // y at the ladder's point
  Index z_offset = 0;       // of z in it

  bool is_explicit() const { return inputs[0].variables.size() == 0 && left_out.size() == 0; }

 private:
  void hold_open(const ExprVector& y, const MatrixXd& J);
  void take_explicit(const ExprVector& y);
};

// x ↦ v with (x, v) ∈ S_f, for a regular ladder: the equations of S_f solved for (v, z, jets) at
// given x.
//
// Off M_f, where the stages of a Runge–Kutta method fall, it is an extension of the field: as many
// independent equations for (v, z, jets) as there are such unknowns are kept, chosen at the
// ladder's point; those that hold x alone, the constraints, are not used. What they leave is the
// violation of the constraints at x. Where those that are kept have become dependent all equations are solved, which
// succeeds on M_f.
class VectorField {
 public:
  using Freedom = VectorFieldFormulas::Freedom;
  VectorField(VectorFieldFormulas formulas, Backend backend);
  // Throws as VectorFieldFormulas do.
  VectorField(std::shared_ptr<const ImplicitSystem> system, const ConstraintLadder& ladder,
              Backend backend, Freedom freedom = Freedom::none)
      : VectorField(VectorFieldFormulas(std::move(system), ladder, freedom), backend) {}

  const VectorFieldFormulas& formulas() const { return formulas_; }
  const std::shared_ptr<const ImplicitSystem>& system() const { return formulas_.system; }
  bool is_native() const { return rate_.is_native(); }
  bool is_explicit() const { return formulas_.is_explicit(); }
  // How many equations are left out, of those that contain v, z or jets.
  Index left_out_count() const { return left_out_.output_size(); }

  // Evaluates along a trajectory, each time starting from the last values; not shared between
  // threads.
  class Evaluation {
   public:
    // `field` has to outlive it.
    explicit Evaluation(const VectorField& field);
    Evaluation(Evaluation&& other) noexcept;
    ~Evaluation();
    // The next evaluation starts from v and z at x, the one after forget() from those at the
    // ladder's point.
    void start(const State& state);
    void forget();
    // Back to the values that the last keep() found.
    void keep() { kept_ = y_; }
    void discard();
    // ẋ = E(x) v, size N. Throws std::domain_error if (v, z, jets) are not found.
    void operator()(const VectorXd& x, VectorXd& rate, double t);
    // The same at a state, starting from its v and z: with gauge freedom, or where there are
    // several branches, the velocity near those.
    void operator()(const State& state, VectorXd& rate);
    // y there, and the basis of its ξ', ….
    const VectorXd& unknowns() const { return y_; }
    const LinearMap<double>& basis() const;
    const VectorXd& v() const { return v_; }
    const VectorXd& z() const { return z_; }
    // What the equations that are left out are at the x of the last evaluation: with constraints
    // that the equations hold only through v, z and jets, their violation; 0 on M_f.
    const VectorXd& left_out() const { return left_out_; }

   private:
    void solve(const VectorXd& x, VectorXd& rate, double t);
    void take_rate(const Inputs& in, VectorXd& rate);
    [[noreturn]] void refuse(const VectorXd& x, double t) const;
    void take_nominal_sizes(const Inputs& in);
    bool holds(const Function& F, const Inputs& in, double solved) const;
    bool is_solved(const Inputs& in);
    bool is_solved_by_all(const Inputs& in, bool is_solved);

    struct Engine;

    const VectorField& field_;
    std::unique_ptr<Engine> engine_;
    VectorXd y_, kept_, out_, v_, z_, left_out_;
    // The largest of left_out that is no fault of the equations that are kept.
    double explained_ = 0.0;
    VectorXd sizes_;  // the largest that each of y_ was; one entry where there is no y_
  };

 private:
  // All equations of y, made when they are asked for first, by whatever thread.
  struct All {
    std::once_flag once;
    Function function;
  };
  const Function& all() const;

  VectorFieldFormulas formulas_;
  // y = (ξ', …, z, …); x, basis, t ↦ the equations kept, less what is held
  std::shared_ptr<const EquationSystem> equations_;
  Function rate_;      // the same ↦ ẋ, v, z
  Function left_out_;  // the same ↦ the equations of y that are not kept
  Function basis_;     // of TransportedFrame
  std::shared_ptr<All> all_ = std::make_shared<All>();
};

}  // namespace courant
