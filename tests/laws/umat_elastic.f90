! Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
! SPDX-License-Identifier: Apache-2.0
!
! Linear elasticity as an Abaqus user material. props: Young's modulus, Poisson's ratio; or the nine constants of an
! orthotropic solid, D1111, D1122, D2222, D1133, D2233, D3333, D1212, D1313, D2323, in the order of Abaqus.
! statev (1) counts the calls, where there is one.
subroutine umat(stress, statev, ddsdde, sse, spd, scd, rpl, ddsddt, drplde, drpldt, stran, dstran, time, dtime, temp, &
                dtemp, predef, dpred, cmname, ndi, nshr, ntens, nstatv, props, nprops, coords, drot, pnewdt, celent, &
                dfgrd0, dfgrd1, noel, npt, layer, kspt, jstep, kinc)
  implicit none
  character(len=80) :: cmname
  integer :: ndi, nshr, ntens, nstatv, nprops, noel, npt, layer, kspt, jstep(4), kinc
  double precision :: stress(ntens), statev(nstatv), ddsdde(ntens, ntens), sse, spd, scd, rpl, ddsddt(ntens), &
                      drplde(ntens), drpldt, stran(ntens), dstran(ntens), time(2), dtime, temp, dtemp, predef(1), &
                      dpred(1), props(nprops), coords(3), drot(3, 3), pnewdt, celent, dfgrd0(3, 3), dfgrd1(3, 3)
  double precision :: shear, lame
  integer :: a

  ddsdde = 0.0d0
  if (nprops == 9) then
    ddsdde(1, 1) = props(1)
    ddsdde(1, 2) = props(2)
    ddsdde(2, 1) = props(2)
    ddsdde(2, 2) = props(3)
    ddsdde(1, 3) = props(4)
    ddsdde(3, 1) = props(4)
    ddsdde(2, 3) = props(5)
    ddsdde(3, 2) = props(5)
    ddsdde(3, 3) = props(6)
    ddsdde(4, 4) = props(7)
    ddsdde(5, 5) = props(8)
    ddsdde(6, 6) = props(9)
  else
    shear = props(1) / (2.0d0 * (1.0d0 + props(2)))
    lame = props(1) * props(2) / ((1.0d0 + props(2)) * (1.0d0 - 2.0d0 * props(2)))
    ddsdde(1:3, 1:3) = lame
    do a = 1, 3
      ddsdde(a, a) = lame + 2.0d0 * shear
      ddsdde(a + 3, a + 3) = shear
    end do
  end if
  stress = stress + matmul(ddsdde, dstran)
  if (nstatv > 0) statev(1) = statev(1) + 1.0d0
end subroutine umat
