! Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
! SPDX-License-Identifier: Apache-2.0
!
! Elastic, perfectly plastic Drucker-Prager soil as an Abaqus user material: sqrt(J2) + alpha I1 = k, flow of slope
! beta. props: Young's modulus, Poisson's ratio, alpha, k, beta. statev(1): accumulated deviatoric plastic strain,
! sum of sqrt(2/3 de:de). The return is backward Euler in closed form; beyond the apex the stress is the apex.
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, &
                dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, &
                dfgrd0, dfgrd1, noel, npt, layer, kspt, jstep, kinc)
  implicit none
  character(len=80) :: cmname
  integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, jstep(4), kinc
  double precision :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens), sse, spd, scd, rpl, ddsddt(ntens), &
                      drplde(ntens), drpldt, stran(ntens), dstran(ntens), time(2), dtime, temp, dtemp, predef(1), &
                      dpred(1), props(nprops), coords(3), drot(3, 3), pnewdt, celent, dfgrd0(3, 3), dfgrd1(3, 3)
  double precision :: shear, bulk, alpha, k, beta, mean, root, yield, slip, new_mean, new_root, deviator(6)
  integer :: a

  shear = props(1) / (2.0d0 * (1.0d0 + props(2)))
  bulk = props(1) / (3.0d0 * (1.0d0 - 2.0d0 * props(2)))
  alpha = props(3)
  k = props(4)
  beta = props(5)
  ddsdde = 0.0d0
  ddsdde(1:3, 1:3) = bulk - 2.0d0 * shear / 3.0d0
  do a = 1, 3
    ddsdde(a, a) = bulk + 4.0d0 * shear / 3.0d0
    ddsdde(a + 3, a + 3) = shear
  end do
  stress = stress + matmul(ddsdde, dstran)

  mean = (stress(1) + stress(2) + stress(3)) / 3.0d0
  deviator = stress
  deviator(1:3) = deviator(1:3) - mean
  root = sqrt(0.5d0 * sum(deviator(1:3)**2) + sum(deviator(4:6)**2))
  yield = root + 3.0d0 * alpha * mean - k
  if (yield <= 4.0d-15 * (root + abs(mean) + k)) return
  slip = yield / (shear + 9.0d0 * bulk * alpha * beta)
  new_mean = mean - 3.0d0 * bulk * beta * slip
  new_root = k - 3.0d0 * alpha * new_mean
  if (new_root < 0.0d0) then
    new_root = 0.0d0
    new_mean = k / (3.0d0 * alpha)
  end if
  if (root > 0.0d0) deviator = deviator * (new_root / root)
  stress = deviator
  stress(1:3) = stress(1:3) + new_mean
  statev(1) = statev(1) + (root - new_root) / (shear * sqrt(3.0d0))
end subroutine umat
