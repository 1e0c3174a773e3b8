!     Moraine: soil-rock mixtures by smoothed particle hydrodynamics.
!     SPDX-License-Identifier: Apache-2.0
!
!     Linear elasticity as user materials are usually written: fixed
!     form, types from the include file. props: Young's modulus,
!     Poisson's ratio.
      SUBROUTINE UMAT(STRESS,STATEV,DDSDDE,SSE,SPD,SCD,
     1 RPL,DDSDDT,DRPLDE,DRPLDT,
     2 STRAN,DSTRAN,TIME,DTIME,TEMP,DTEMP,PREDEF,DPRED,CMNAME,
     3 NDI,NSHR,NTENS,NSTATV,PROPS,NPROPS,COORDS,DROT,PNEWDT,
     4 CELENT,DFGRD0,DFGRD1,NOEL,NPT,LAYER,KSPT,JSTEP,KINC)
C
      INCLUDE 'ABA_PARAM.INC'
C
      CHARACTER*80 CMNAME
      DIMENSION STRESS(NTENS),STATEV(NSTATV),
     1 DDSDDE(NTENS,NTENS),DDSDDT(NTENS),DRPLDE(NTENS),
     2 STRAN(NTENS),DSTRAN(NTENS),TIME(2),PREDEF(1),DPRED(1),
     3 PROPS(NPROPS),COORDS(3),DROT(3,3),DFGRD0(3,3),DFGRD1(3,3),
     4 JSTEP(4)
C
      SHEAR = PROPS(1)/(2.D0*(1.D0 + PROPS(2)))
      ELAME = 2.D0*SHEAR*PROPS(2)/(1.D0 - 2.D0*PROPS(2))
      DO 20 K1 = 1,NTENS
        DO 10 K2 = 1,NTENS
          DDSDDE(K2,K1) = 0.D0
   10   CONTINUE
   20 CONTINUE
      DO 40 K1 = 1,NDI
        DO 30 K2 = 1,NDI
          DDSDDE(K2,K1) = ELAME
   30   CONTINUE
        DDSDDE(K1,K1) = ELAME + 2.D0*SHEAR
        DDSDDE(NDI + K1,NDI + K1) = SHEAR
   40 CONTINUE
      DO 60 K1 = 1,NTENS
        DO 50 K2 = 1,NTENS
          STRESS(K1) = STRESS(K1) + DDSDDE(K1,K2)*DSTRAN(K2)
   50   CONTINUE
   60 CONTINUE
      RETURN
      END
