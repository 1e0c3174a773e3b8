! Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
! SPDX-License-Identifier: Apache-2.0
!
! A user material with a fault, for tests of what catches it: linear elasticity, and then what props(3) says.
!  0 none             1 not a number       2 asks for a smaller step      3 writes behind statev
!  4 writes behind stress                  5 writes to address zero       6 is not objective
!  7 takes the shear components in another order than 12, 13, 23          8 as 7, in the right order
!  9 allocates and never frees            10 stops the program           11 as 5, after props(4) seconds
! 12 keeps what it is told in statev      13 keeps scratch in a common block   14 deep recursion
! 15 stress against the strain             16 writes STATEV(3)             17 writes STATEV(40)
! 18 adds to STATEV(nstatv + 1) in a strain 19 adds to what stands 63 numbers behind the last
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, &
                dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, &
                dfgrd0, dfgrd1, noel, npt, layer, kspt, jstep, kinc)
  use iso_c_binding
  implicit none
  character(len=80) :: cmname
  integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, jstep(4), kinc
  double precision :: stress(*), statev(*), ddsdde(ntens, ntens), sse, spd, scd, rpl, ddsddt(ntens), &
                      drplde(ntens), drpldt, stran(ntens), dstran(ntens), time(2), dtime, temp, dtemp, predef(1), &
                      dpred(1), props(nprops), coords(3), drot(3, 3), pnewdt, celent, dfgrd0(3, 3), dfgrd1(3, 3)
  double precision :: shear, lame, scratch(6), zero
  double precision, pointer :: nowhere, kept(:)
  integer :: a, fault, count
  integer(c_intptr_t) :: address
  common /kept/ scratch

  fault = nint(props(3))
  shear = props(1) / (2.0d0 * (1.0d0 + props(2)))
  lame = props(1) * props(2) / ((1.0d0 + props(2)) * (1.0d0 - 2.0d0 * props(2)))
  ddsdde = 0.0d0
  ddsdde(1:3, 1:3) = lame
  do a = 1, 3
    ddsdde(a, a) = lame + 2.0d0 * shear
    ddsdde(a + 3, a + 3) = shear
  end do
  scratch = matmul(ddsdde, dstran)
  if (fault == 13) then
    do count = 1, 200 ! long enough for another thread to come between
      scratch = matmul(ddsdde, dstran)
    end do
  end if
  stress(1:6) = stress(1:6) + scratch
  zero = 0.0d0
  select case (fault)
  case (1)
    if (any(dstran /= 0.0d0)) stress(2) = zero / zero
  case (2)
    if (maxval(abs(dstran)) > 1.0d-3) pnewdt = 0.5d0
  case (3)
    statev(nstatv + 1) = 1.0d0
  case (4)
    stress(7) = 1.0d0
  case (5)
    address = 0
    call c_f_pointer(transfer(address, c_null_ptr), nowhere)
    nowhere = 1.0d0
  case (6)
    stress(1) = stress(1) + 0.5d0 * shear * dstran(1)
  case (7, 8)
    call soften(merge(6, 5, fault == 7), merge(5, 6, fault == 7))
  case (9)
    if (any(dstran /= 0.0d0)) then
      allocate (kept(1000))
      kept = stress(1)
    end if
  case (10)
    if (any(dstran /= 0.0d0)) stop 3
  case (11)
    if (time(1) >= props(4)) then
      address = 0
      call c_f_pointer(transfer(address, c_null_ptr), nowhere)
      nowhere = 1.0d0
    end if
  case (12)
    statev(1:9) = reshape(dfgrd1, [9])
    statev(10:15) = stran + dstran
    statev(16:18) = [time(1), time(2), dtime]
    statev(19:27) = reshape(drot, [9])
  case (15)
    stress(1:6) = stress(1:6) - 2.0d0 * scratch
  case (16)
    statev(3) = dtime
  case (17)
    statev(40) = dtime
  case (18)
    if (any(dstran /= 0.0d0)) statev(nstatv + 1) = statev(nstatv + 1) + 1.0d-9 * sqrt(sum(dstran**2))
  case (19)
    statev(nstatv + 64) = statev(nstatv + 64) + 1.0d-9 * sqrt(sum(dstran**2))
  case (14)
    if (any(dstran /= 0.0d0)) stress(1) = descend(1.0d0)
  end select

contains
  ! The stress becomes smaller with its determinant, an invariant only if i13 and i23 are its places in it.
  subroutine soften(i13, i23)
    integer, intent(in) :: i13, i23
    double precision :: determinant, size
    size = sqrt(sum(dstran(1:3)**2) + 0.5d0 * sum(dstran(4:6)**2))
    determinant = stress(1) * (stress(2) * stress(3) - stress(i23)**2) &
                  - stress(4) * (stress(4) * stress(3) - stress(i23) * stress(i13)) &
                  + stress(i13) * (stress(4) * stress(i23) - stress(2) * stress(i13))
    stress(1:6) = stress(1:6) * (1.0d0 - 0.05d0 * tanh(1.0d9 * determinant / props(1)**3) * size)
  end subroutine soften

  recursive function descend(x) result(y)
    double precision, intent(in) :: x
    double precision :: y, room(1000)
    room = x
    y = descend(room(500) + 1.0d0) + room(200)
  end function descend
end subroutine umat
