#include "modules/vo/five_point.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Householder>
#include <Eigen/LU>
#include <cmath>

namespace plumb::vo {
namespace {

// Polynomials in (x, y, z) up to degree 3. The monomials are the ten cubic ones, then
// x2 xy xz y2 yz z2 x y z 1, which are the basis of the quotient ring.
struct Exponents {
  int x, y, z;
};
constexpr int kNumMonomials = 20;
constexpr std::array<Exponents, kNumMonomials> kMonomials{
    {{3, 0, 0}, {2, 1, 0}, {2, 0, 1}, {1, 2, 0}, {1, 1, 1}, {1, 0, 2}, {0, 3, 0},
     {0, 2, 1}, {0, 1, 2}, {0, 0, 3}, {2, 0, 0}, {1, 1, 0}, {1, 0, 1}, {0, 2, 0},
     {0, 1, 1}, {0, 0, 2}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 0}}};
constexpr int kFirstLinear = 16;
constexpr int kFirstQuadratic = 10;

// Index of the product of two monomials, -1 when its degree exceeds 3.
constexpr std::array<std::array<int, kNumMonomials>, kNumMonomials> product_table() {
  std::array<std::array<int, kNumMonomials>, kNumMonomials> table{};
  for (std::size_t a = 0; a < kNumMonomials; ++a) {
    for (std::size_t b = 0; b < kNumMonomials; ++b) {
      table[a][b] = -1;
      for (std::size_t c = 0; c < kNumMonomials; ++c) {
        if (kMonomials[c].x == kMonomials[a].x + kMonomials[b].x &&
            kMonomials[c].y == kMonomials[a].y + kMonomials[b].y &&
            kMonomials[c].z == kMonomials[a].z + kMonomials[b].z) {
          table[a][b] = static_cast<int>(c);
        }
      }
    }
  }
  return table;
}
constexpr auto kProduct = product_table();

using Polynomial = Eigen::Matrix<double, 1, kNumMonomials>;
using PolynomialMatrix = std::array<std::array<Polynomial, 3>, 3>;

// Multiplies `a`, whose terms begin at `first_a`, by the linear `b`.
Polynomial multiply(const Polynomial& a, int first_a, const Polynomial& b) {
  Polynomial out = Polynomial::Zero();
  for (int i = first_a; i < kNumMonomials; ++i) {
    for (int j = kFirstLinear; j < kNumMonomials; ++j) {
      out[kProduct[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)]] += a[i] * b[j];
    }
  }
  return out;
}

// Returns E1 to E4, row by row, as columns.
Eigen::Matrix<double, 9, 4> null_space(const std::array<RayPair, 5>& pairs) {
  Eigen::Matrix<double, 9, 5> A;
  for (int i = 0; i < 5; ++i) {
    const RayPair& pair = pairs[static_cast<std::size_t>(i)];
    const Eigen::Vector3d a = pair.first.homogeneous();
    const Eigen::Vector3d b = pair.second.homogeneous();
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) A(3 * r + c, i) = b[r] * a[c];
    }
  }
  // These are the steps of Eigen's HouseholderQR for a small matrix. Its own code for large ones
  // would be compiled, too, which takes seconds.
  auto QR = A.block(0, 0, 9, 5);
  Eigen::Matrix<double, 5, 1> scale;
  Eigen::Matrix<double, 1, 9> workspace;
  for (int k = 0; k < 5; ++k) {
    double beta = 0.0;
    QR.col(k).tail(9 - k).makeHouseholderInPlace(scale[k], beta);
    QR(k, k) = beta;
    QR.bottomRightCorner(9 - k, 4 - k)
        .applyHouseholderOnTheLeft(QR.col(k).tail(8 - k), scale[k], workspace.data());
  }
  Eigen::Matrix<double, 9, 9> Q = Eigen::Matrix<double, 9, 9>::Identity();
  for (int k = 4; k >= 0; --k) {
    Q.bottomRightCorner(9 - k, 9).applyHouseholderOnTheLeft(A.col(k).tail(8 - k), scale[k],
                                                            workspace.data());
  }
  return Q.rightCols<4>();
}

// Returns the coefficients of the ten cubic equations.
Eigen::Matrix<double, 10, kNumMonomials> constraints(const PolynomialMatrix& E) {
  PolynomialMatrix EEt;
  Polynomial trace = Polynomial::Zero();
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      EEt[i][j].setZero();
      for (std::size_t k = 0; k < 3; ++k) {
        EEt[i][j] += multiply(E[i][k], kFirstLinear, E[j][k]);
      }
    }
    trace += EEt[i][i];
  }
  Eigen::Matrix<double, 10, kNumMonomials> C;
  Eigen::Index row = 0;
  for (std::size_t i = 0; i < 3; ++i) EEt[i][i] -= 0.5 * trace;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      Polynomial p = Polynomial::Zero();
      for (std::size_t k = 0; k < 3; ++k) p += multiply(EEt[i][k], kFirstQuadratic, E[k][j]);
      C.row(row++) = p;
    }
  }
  Polynomial det = Polynomial::Zero();
  for (std::size_t k = 0; k < 3; ++k) {  // Laplace expansion along the first row
    const std::size_t a = (k + 1) % 3;
    const std::size_t b = (k + 2) % 3;
    const Polynomial minor =
        multiply(E[1][a], kFirstLinear, E[2][b]) - multiply(E[1][b], kFirstLinear, E[2][a]);
    det += multiply(minor, kFirstQuadratic, E[0][k]);
  }
  C.row(row) = det;
  return C;
}

}  // namespace

void solve_five_point(const std::array<RayPair, 5>& pairs, EssentialSolutions* solutions) {
  using Matrix10d = Eigen::Matrix<double, 10, 10>;
  solutions->clear();
  const Eigen::Matrix<double, 9, 4> N = null_space(pairs);
  PolynomialMatrix E;
  for (int r = 0; r < 3; ++r) {
    for (int c = 0; c < 3; ++c) {
      Polynomial& p = E[static_cast<std::size_t>(r)][static_cast<std::size_t>(c)];
      p.setZero();
      p.tail<4>() = N.row(3 * r + c);
    }
  }
  const Eigen::Matrix<double, 10, kNumMonomials> C = constraints(E);
  const Eigen::PartialPivLU<Matrix10d> lu(Matrix10d(C.leftCols<10>()));
  const Matrix10d B = lu.solve(Matrix10d(C.rightCols<10>()));
  if (!B.allFinite()) return;

  Matrix10d M = Matrix10d::Zero();
  for (int i = 0; i < 6; ++i) M.row(i) = -B.row(i);
  M(6, 0) = M(7, 1) = M(8, 2) = M(9, 6) = 1.0;
  const Eigen::EigenSolver<Matrix10d> eigen(M);
  if (eigen.info() != Eigen::Success) return;
  for (int i = 0; i < 10; ++i) {
    const std::complex<double> value = eigen.eigenvalues()[i];
    if (std::abs(value.imag()) > 1e-8 * (1.0 + std::abs(value.real()))) continue;
    const Eigen::Matrix<double, 10, 1> v = eigen.eigenvectors().col(i).real();
    if (std::abs(v[9]) < 1e-12) continue;
    const Eigen::Vector4d xyz1(v[6] / v[9], v[7] / v[9], v[8] / v[9], 1.0);
    const Eigen::Matrix<double, 9, 1> e = (N * xyz1).normalized();
    Eigen::Matrix3d found;
    for (int k = 0; k < 9; ++k) found(k / 3, k % 3) = e[k];
    static_cast<void>(solutions->push_back(found));
  }
}

}  // namespace plumb::vo
