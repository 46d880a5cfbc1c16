// Balls of a build without Arb: all are the whole line, which proves nothing.
#include <limits>

#include "courant/core/numbers/ball.hpp"

namespace courant {

bool Ball::is_available() { return false; }

Ball::Ball() = default;
Ball::Ball(double /*number*/) {}
Ball::Ball(const Ball& /*other*/) {}
Ball::Ball(Ball&& /*other*/) noexcept {}
Ball& Ball::operator=(Ball /*other*/) noexcept { return *this; }
Ball::~Ball() = default;

Ball Ball::written(double /*number*/) { return {}; }

bool Ball::is_zero() const { return false; }
bool Ball::is_exact() const { return false; }
bool Ball::is_finite() const { return false; }
bool Ball::contains_zero() const { return true; }
bool Ball::contains_inside(const Ball& /*other*/) const { return false; }
int Ball::sign() const { return 0; }
Ball::operator double() const { return std::numeric_limits<double>::quiet_NaN(); }
double Ball::radius() const { return std::numeric_limits<double>::infinity(); }
double Ball::least_size() const { return 0.0; }
Ball Ball::midpoint() const { return {}; }
Ball Ball::widened_by(const Ball& /*other*/, int /*exponent*/) const { return {}; }

Ball operator-(const Ball& /*a*/) { return {}; }
Ball operator+(const Ball& /*a*/, const Ball& /*b*/) { return {}; }
Ball operator-(const Ball& /*a*/, const Ball& /*b*/) { return {}; }
Ball operator*(const Ball& /*a*/, const Ball& /*b*/) { return {}; }
Ball operator/(const Ball& /*a*/, const Ball& /*b*/) { return {}; }

Ball evaluate(Op /*op*/, const Ball& /*a*/) { return {}; }
Ball pow(const Ball& /*a*/, const Ball& /*p*/) { return {}; }
Ball atan2(const Ball& /*y*/, const Ball& /*x*/) { return {}; }

}  // namespace courant
