! Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
! SPDX-License-Identifier: Apache-2.0
!
! Elastic, perfectly plastic Mohr-Coulomb soil as an Abaqus user material, by return in principal stresses: to the
! plane, to an edge, to the apex. props: Young's modulus, Poisson's ratio, friction angle, cohesion, dilation angle
! (radians). Yield: (s1 - s3) + (s1 + s3) sin(phi) - 2 c cos(phi) = 0, s1 >= s2 >= s3, tension positive.
module mohr_coulomb_principal
  implicit none
  integer, parameter :: dp = kind(1.0d0)
contains
  ! Eigenvalues in falling order and eigenvectors, in columns, of a symmetric matrix; cyclic Jacobi rotations.
  subroutine find_principal(matrix, values, vectors)
    real(dp), intent(in) :: matrix(3, 3)
    real(dp), intent(out) :: values(3), vectors(3, 3)
    real(dp) :: a(3, 3), theta, t, c, s, column(3), swap
    integer :: sweep, p, q, k
    a = matrix
    vectors = 0.0_dp
    do k = 1, 3
      vectors(k, k) = 1.0_dp
    end do
    do sweep = 1, 12
      do p = 1, 2
        do q = p + 1, 3
          if (abs(a(p, q)) <= tiny(1.0_dp)) cycle
          theta = (a(q, q) - a(p, p)) / (2.0_dp * a(p, q))
          t = sign(1.0_dp, theta) / (abs(theta) + sqrt(1.0_dp + theta * theta))
          c = 1.0_dp / sqrt(1.0_dp + t * t)
          s = t * c
          column = c * a(:, p) - s * a(:, q)
          a(:, q) = s * a(:, p) + c * a(:, q)
          a(:, p) = column
          column = c * a(p, :) - s * a(q, :)
          a(q, :) = s * a(p, :) + c * a(q, :)
          a(p, :) = column
          column = c * vectors(:, p) - s * vectors(:, q)
          vectors(:, q) = s * vectors(:, p) + c * vectors(:, q)
          vectors(:, p) = column
        end do
      end do
    end do
    do k = 1, 3
      values(k) = a(k, k)
    end do
    do p = 1, 2
      do q = p + 1, 3
        if (values(q) > values(p)) then
          swap = values(p)
          values(p) = values(q)
          values(q) = swap
          column = vectors(:, p)
          vectors(:, p) = vectors(:, q)
          vectors(:, q) = column
        end if
      end do
    end do
  end subroutine find_principal

  ! The return of principal trial stresses.
  subroutine return_principal(bulk, shear, sine, strength, flow, s)
    real(dp), intent(in) :: bulk, shear, sine, strength, flow
    real(dp), intent(inout) :: s(3)
    real(dp) :: yield, a, b, f2, slip1, slip2, trial(3), apex, work
    trial = s
    yield = s(1) - s(3) + (s(1) + s(3)) * sine - strength
    if (yield <= 8.0_dp * epsilon(1.0_dp) * (abs(s(1)) + abs(s(3)) + strength)) return
    ! The main plane.
    a = 4.0_dp * shear * (1.0_dp + sine * flow / 3.0_dp) + 4.0_dp * bulk * sine * flow
    slip1 = yield / a
    call flow_step(bulk, shear, flow, slip1, 1, 3, s)
    if (s(1) >= s(2) .and. s(2) >= s(3)) return
    ! An edge: the right one (s2 = s3) or the left one (s1 = s2).
    work = (1.0_dp - flow) * trial(1) - 2.0_dp * trial(2) + (1.0_dp + flow) * trial(3)
    s = trial
    if (work > 0.0_dp) then
      b = 2.0_dp * shear * (1.0_dp + sine + flow - sine * flow / 3.0_dp) + 4.0_dp * bulk * sine * flow
      f2 = s(1) - s(2) + (s(1) + s(2)) * sine - strength
      slip1 = (a * yield - b * f2) / (a * a - b * b)
      slip2 = (a * f2 - b * yield) / (a * a - b * b)
      call flow_step(bulk, shear, flow, slip1, 1, 3, s)
      call flow_step(bulk, shear, flow, slip2, 1, 2, s)
    else
      b = 2.0_dp * shear * (1.0_dp - sine - flow - sine * flow / 3.0_dp) + 4.0_dp * bulk * sine * flow
      f2 = s(2) - s(3) + (s(2) + s(3)) * sine - strength
      slip1 = (a * yield - b * f2) / (a * a - b * b)
      slip2 = (a * f2 - b * yield) / (a * a - b * b)
      call flow_step(bulk, shear, flow, slip1, 1, 3, s)
      call flow_step(bulk, shear, flow, slip2, 2, 3, s)
    end if
    if (sine > 0.0_dp) then
      apex = strength / (2.0_dp * sine)
      if (sum(s) / 3.0_dp > apex .or. .not. (s(1) - s(3) > -1.0e-12_dp * strength)) s = apex
    end if
  end subroutine return_principal

  ! Takes elastic stress of plastic flow on the plane of the directions i (largest) and j (smallest) away.
  subroutine flow_step(bulk, shear, flow, slip, i, j, s)
    real(dp), intent(in) :: bulk, shear, flow, slip
    integer, intent(in) :: i, j
    real(dp), intent(inout) :: s(3)
    real(dp) :: normal(3), volume
    normal = 0.0_dp
    normal(i) = 1.0_dp + flow
    normal(j) = -(1.0_dp - flow)
    volume = sum(normal)
    s = s - slip * (2.0_dp * shear * (normal - volume / 3.0_dp) + bulk * volume)
  end subroutine flow_step
end module mohr_coulomb_principal

subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, &
                dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, &
                dfgrd0, dfgrd1, noel, npt, layer, kspt, jstep, kinc)
  use mohr_coulomb_principal
  implicit none
  character(len=80) :: cmname
  integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, jstep(4), kinc
  double precision :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens), sse, spd, scd, rpl, ddsddt(ntens), &
                      drplde(ntens), drpldt, stran(ntens), dstran(ntens), time(2), dtime, temp, dtemp, predef(1), &
                      dpred(1), props(nprops), coords(3), drot(3, 3), pnewdt, celent, dfgrd0(3, 3), dfgrd1(3, 3)
  double precision :: shear, bulk, matrix(3, 3), vectors(3, 3), s(3), trial(3)
  integer :: a

  shear = props(1) / (2.0d0 * (1.0d0 + props(2)))
  bulk = props(1) / (3.0d0 * (1.0d0 - 2.0d0 * props(2)))
  ddsdde = 0.0d0
  ddsdde(1:3, 1:3) = bulk - 2.0d0 * shear / 3.0d0
  do a = 1, 3
    ddsdde(a, a) = bulk + 4.0d0 * shear / 3.0d0
    ddsdde(a + 3, a + 3) = shear
  end do
  stress = stress + matmul(ddsdde, dstran)
  matrix(1, :) = [stress(1), stress(4), stress(5)]
  matrix(2, :) = [stress(4), stress(2), stress(6)]
  matrix(3, :) = [stress(5), stress(6), stress(3)]
  call find_principal(matrix, s, vectors)
  trial = s
  call return_principal(bulk, shear, sin(props(3)), 2.0d0 * props(4) * cos(props(3)), sin(props(5)), s)
  if (all(s == trial)) return
  do a = 1, 3
    matrix(a, 1) = sum(vectors(a, :) * s * vectors(1, :))
    matrix(a, 2) = sum(vectors(a, :) * s * vectors(2, :))
    matrix(a, 3) = sum(vectors(a, :) * s * vectors(3, :))
  end do
  stress = [matrix(1, 1), matrix(2, 2), matrix(3, 3), matrix(1, 2), matrix(1, 3), matrix(2, 3)]
end subroutine umat
